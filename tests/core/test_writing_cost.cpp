// SPDX-License-Identifier: BSD-3-Clause
// The cost of writing grows linearly with the nodes: no loop over nodes launches a kernel over all
// of them. The test counts kernels, so it does not depend on time.
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "geometry/shapes.hpp"
#include "io/hdf5.hpp"
#include "io/write_files.hpp"
#include "placement/placement_impl.hpp"
#include "run_kernel_suite.hpp"

namespace {

std::int64_t kernels = 0;

void count_kernel(const char*, std::uint32_t, std::uint64_t*) { ++kernels; }

template <class Work>
std::int64_t kernels_of(const Work& work) {
  namespace tools = Kokkos::Tools::Experimental;
  kernels = 0;
  tools::set_begin_parallel_for_callback(count_kernel);
  tools::set_begin_parallel_reduce_callback(count_kernel);
  tools::set_begin_parallel_scan_callback(count_kernel);
  work();
  tools::set_begin_parallel_for_callback(nullptr);
  tools::set_begin_parallel_reduce_callback(nullptr);
  tools::set_begin_parallel_scan_callback(nullptr);
  return kernels;
}

template <int Dim, class SomeDomain>
std::unique_ptr<pnpbs::PlacementImpl<Dim>> placed(std::shared_ptr<SomeDomain> domain, double d) {
  pnpbs::Options options;
  options.set("steps", "4");
  options.set("sweeps", "0");
  auto placement = std::make_unique<pnpbs::PlacementImpl<Dim>>(pnpbs::serial_communicator(),
                                                               std::move(domain), options);
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<Dim>>(d));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  placement->results().prepare_stars();
  return placement;
}

std::unique_ptr<pnpbs::PlacementImpl<2>> square(double d) {
  auto domain = std::make_shared<pnpbs::PlaneDomain>();
  shapes::add_loop(*domain, shapes::rectangle(0, 0, 1, 1));
  return placed<2>(std::move(domain), d);
}

std::unique_ptr<pnpbs::PlacementImpl<3>> cube(double d) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  return placed<3>(std::move(domain), d);
}

// Kernels that do not depend on the number of nodes, or vary little with it.
constexpr std::int64_t kMaxMore = 8;

bool has_hdf5() {
  try {
    pnpbs::io::hdf5::require_hdf5();
    return true;
  } catch (const pnpbs::Error&) {
    return false;
  }
}

// Returns whether the format applies to the plane or to bodies.
bool can_write(const pnpbs::io::Format& format, int dimension) {
  using pnpbs::io::Of;
  const Of own = dimension == 3 ? Of::bodies : Of::triangles;
  return (!format.by_hdf5 || has_hdf5()) && (format.of == Of::anything || format.of == own);
}

// Returns the fields that files of particles require.
pnpbs::io::OutputFields fields_of(pnpbs::Placement& placement) {
  pnpbs::io::OutputFields fields;
  const std::vector<double> ones(static_cast<std::size_t>(placement.results().count()), 1);
  for (const char* name : {"volume", "density"})
    fields.add(placement.results(), name, std::ssize(ones), 1, ones.data());
  return fields;
}

// `more` has several times the nodes of `few`.
void expect_same_kernels(pnpbs::Placement& few, pnpbs::Placement& more) {
  ck_assert_int_gt(more.results().count(), 3 * few.results().count());
  for (const pnpbs::io::Format& format : pnpbs::io::formats()) {
    if (!can_write(format, few.dimension())) continue;
    const std::string path = std::string("test_writing_cost.") + format.name;
    for (const bool elements : {false, true}) {
      if (elements && (format.elements == pnpbs::io::Elements::never || !format.fields.empty()))
        continue;
      const auto kernels_to_write = [&](pnpbs::Placement& placement) {
        std::vector<pnpbs::io::FileRequest> requests;
        pnpbs::io::add_request(path, "", elements, pnpbs::io::requested_of(placement), requests);
        const pnpbs::io::OutputFields fields = fields_of(placement);
        return kernels_of([&] { pnpbs::io::write_files(placement, fields, requests); });
      };
      const std::int64_t of_few = kernels_to_write(few), of_more = kernels_to_write(more);
      ck_assert_msg(of_more <= of_few + kMaxMore, "%s: %lld kernels for %lld nodes, %lld for %lld",
                    path.c_str(), static_cast<long long>(of_few),
                    static_cast<long long>(few.results().count()), static_cast<long long>(of_more),
                    static_cast<long long>(more.results().count()));
    }
  }
}

START_TEST(writing_launches_no_kernel_per_node) {
  const auto few = square(0.04), more = square(0.008);  // more than one window
  expect_same_kernels(*few, *more);
  const auto coarse = cube(0.2), fine = cube(0.1);
  expect_same_kernels(*coarse, *fine);
}
END_TEST

START_TEST(the_number_of_nodes_is_counted_once) {
  const auto placement = square(0.04);
  placement->results().prepare_order();
  const std::int64_t nodes = placement->results().count();
  const std::int64_t launched = kernels_of([&] {
    for (std::int64_t i = 0; i < placement->results().count(); ++i)
      ck_assert_int_eq(nodes, placement->results().count());
  });
  ck_assert_int_eq(launched, 0);
}
END_TEST

}  // namespace

TEST_SUITE(test_writing_cost) {
  char folder[] = "/tmp/pnpbs-writing-XXXXXX";
  if (!mkdtemp(folder)) return 1;
  std::filesystem::current_path(folder);
  const int status = run_kernel_suite(
      "writing_cost", {writing_launches_no_kernel_per_node, the_number_of_nodes_is_counted_once});
  std::filesystem::current_path("/tmp");
  std::filesystem::remove_all(folder);
  return status;
}
