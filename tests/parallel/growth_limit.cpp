// SPDX-License-Identifier: BSD-3-Clause
// Tests the growth limit over ranks: equal to the bit with one process, with a part of the tree on
// each rank; a collective spacing; and failures on one rank.
#include "spacing/growth_limit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "core/level_run.hpp"
#include "core/limited_spacing.hpp"
#include "core/line_of_sight.hpp"
#include "core/random.hpp"
#include "core/volume_growth.hpp"
#include "rank_checks.hpp"

namespace {

using pnpbs::PlaneDomain;
using pnpbs::Spacing;
using rank_checks::comm;
using rank_checks::expect;
using shapes::add_loop;
using shapes::rectangle;
using Limited = pnpbs::SizingField<2>;
using P = pnpbs::Point<2>;

constexpr std::int64_t kManyNodes = 1'000'000'000;

struct Case {
  const char* name;
  Build build;
  Plane d;
  double growth;
};

void add_square(PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 1)); }

void add_horseshoe(PlaneDomain& domain) {
  const std::vector<double> xy{0, 0, 1, 0, 1, 1, 0, 1, 0, 0.6, 0.8, 0.6, 0.8, 0.4, 0, 0.4};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 8, xy.data(), nullptr, 0);
}

double pits(double x, double y) {
  return std::min(0.1, 0.004 + 0.7 * std::min(std::hypot(x - 0.31, y - 0.42),
                                              0.001 + std::hypot(x - 0.8, y - 0.77)));
}

std::vector<Case> cases() {
  return {
      {"constant", add_square, constant(0.3), 0.2},  // a few leaves, so some ranks have none
      {"pits", add_square, pits, 0.15},
      {"jump", add_square, [](double x, double) { return x > 0.503 ? 1.0 : 0.01; }, 0.3},
      {"slow", add_square, [](double x, double y) { return x + y < 0.03 ? 0.008 : 0.1; }, 0.02},
      {"checks", add_square,
       [](double x, double y) { return std::sin(30 * x) * std::sin(30 * y) > 0.3 ? 0.008 : 0.05; },
       0.2},
      {"horseshoe", add_horseshoe, [](double x, double y) { return x + y < 1e-3 ? 0.004 : 0.03; },
       0.01},
      {"islands", [](PlaneDomain& p) { add_lake(p, "great_lakes_islands"); },
       [](double x, double y) { return 3 + 0.4 * std::hypot(x, y); }, 0.05},
  };
}

// A collective spacing, such as d from a solver: all ranks must evaluate it at the same time.
class CollectiveSpacing : public Spacing<2> {
 public:
  explicit CollectiveSpacing(Plane d) : d_(std::move(d)) {}
  void evaluate(std::int64_t n, const P* x, double* values) const override {
    ++calls_;
    if (comm->allreduce_max(calls_) != calls_)
      throw pnpbs::Error(pnpbs::ErrorKind::internal, "not asked by all ranks at the same time");
    for (std::int64_t i = 0; i < n; ++i) values[i] = d_(x[i][0], x[i][1]);
  }

 private:
  Plane d_;
  mutable double calls_ = 0;
};

std::vector<P> points_in(const PlaneDomain& domain, std::uint64_t seed, int many) {
  Random random(seed);
  std::vector<P> points;
  for (int k = 0; k < many; ++k) points.push_back(random.point<2>(domain.bounds()));
  return points;
}

std::vector<double> values_at(const Spacing<2>& spacing, const std::vector<P>& x) {
  std::vector<double> d(x.size());
  spacing.evaluate(std::ssize(x), x.data(), d.data());
  return d;
}

void expect_same_bits(const Spacing<2>& one, const Spacing<2>& other, const std::vector<P>& points,
                      const std::string& what) {
  const std::vector<double> a = values_at(one, points), b = values_at(other, points);
  expect(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0, what);
}

double sum_over_ranks(std::int64_t value) {
  return static_cast<double>(comm->allreduce_sum(static_cast<std::uint64_t>(value)));
}

void check_case(const Case& c) {
  PlaneDomain domain;
  c.build(domain);
  domain.check();
  const Limited alone =
      limited_spacing<2>(pnpbs::serial_communicator(), line_of_sight(domain, *spacing_of(c.d)),
                         spacing_of(c.d), c.growth, kManyNodes);
  const auto asked = std::make_shared<CollectiveSpacing>(c.d);
  const Limited together =
      limited_spacing<2>(comm, line_of_sight(domain, *asked), asked, c.growth, kManyNodes);
  const auto seed = static_cast<std::uint64_t>(comm->rank());
  expect_same_bits(alone, together, points_in(domain, 99, 5000),
                   std::string(c.name) + ": the same where all ask the same points");
  expect_same_bits(alone, together, points_in(domain, seed, 5000),
                   std::string(c.name) + ": the same where each asks its own");
  expect_same_bits(alone, together, points_in(domain, seed, comm->rank() == 0 ? 3000 : 0),
                   std::string(c.name) + ": the same where one rank asks");
  // A rank holds copies of leaves in a band along its border, and of some large leaves beside it.
  const auto whole = static_cast<double>(alone.growth_limit()->leaves_held());
  const double share = whole / comm->size(),
               max =
                   comm->allreduce_max(static_cast<double>(together.growth_limit()->leaves_held()));
  expect(max <= share + 16 * std::sqrt(share) + 60, std::string(c.name) + ": a rank holds " +
                                                        std::to_string(max) + " of " +
                                                        std::to_string(whole) + " leaves");
  expect(sum_over_ranks(together.growth_limit()->leaves_held()) >= whole,
         "all leaves are somewhere");
}

void check_volume() {
  const volume_growth::Block block(true, {0.9, 0.3, 0.2});
  const auto limited = [&](const std::shared_ptr<const pnpbs::Communicator>& ranks) {
    return limited_spacing<3>(ranks, block.ways(), block.spacing(), block.kGrowth, kManyNodes);
  };
  std::vector<pnpbs::Point<3>> points;
  Random random(static_cast<std::uint64_t>(comm->rank()));
  while (points.size() < 2000) {
    const pnpbs::Point<3> x = random.point<3>(block.bounds());
    if (block.inside(x)) points.push_back(x);
  }
  std::vector<double> alone(points.size()), together(points.size());
  limited(pnpbs::serial_communicator()).evaluate(std::ssize(points), points.data(), alone.data());
  limited(comm).evaluate(std::ssize(points), points.data(), together.data());
  expect(std::memcmp(alone.data(), together.data(), alone.size() * sizeof(double)) == 0,
         "a block in space: the same bits");
}

// ------------------------------------------------------------------ failures -------------------

template <class Work>
void expect_failure(pnpbs::ErrorKind kind, const std::string& text, const Work& work) {
  try {
    work();
    expect(false, "no failure with " + text);
  } catch (const pnpbs::Error& error) {
    expect(error.kind() == kind && std::string(error.what()).find(text) != std::string::npos,
           std::string("not of ") + text + ": " + error.what());
  }
}

void check_failures() {
  PlaneDomain domain;
  add_square(domain);
  domain.check();
  const Plane even = constant(0.02);
  int beats = 0;
  const auto make = [&](const Plane& d, std::int64_t max_nodes, const std::function<void()>& beat) {
    const auto asked = std::make_shared<CollectiveSpacing>(d);
    limited_spacing<2>(comm, line_of_sight(domain, *spacing_of(even)), asked, 0.1, max_nodes, beat);
  };
  make(even, kManyNodes, [&] { ++beats; });
  // The run stops on all ranks whenever the last rank's monitor stops it.
  const int last = comm->rank() == comm->size() - 1 ? beats : 0;
  beats = static_cast<int>(comm->allreduce_max(last));
  expect(beats > 5, "the monitor is asked now and then");
  for (int stop = 0; stop < beats; stop += 1 + beats / 5)
    expect_failure(pnpbs::ErrorKind::stopped, "enough", [&] {
      int left = stop;
      make(even, kManyNodes, [&] {
        if (comm->rank() == comm->size() - 1 && left-- == 0)
          throw pnpbs::Error(pnpbs::ErrorKind::stopped, "enough");
      });
    });
  const auto bad_in_a_corner = [](double bad) {
    return [bad](double x, double y) { return x > 0.9 && y > 0.9 && x + y < 1.99 ? bad : 0.02; };
  };
  expect_failure(pnpbs::ErrorKind::spacing, "d = nan at (",
                 [&] { make(bad_in_a_corner(std::nan("")), kManyNodes, [] {}); });
  expect_failure(pnpbs::ErrorKind::spacing, "d = -1 at (",
                 [&] { make(bad_in_a_corner(-1), kManyNodes, [] {}); });
  expect_failure(pnpbs::ErrorKind::spacing, "the option max_nodes allows 1500",
                 [&] { make(even, 1500, [] {}); });
  expect_failure(pnpbs::ErrorKind::memory, "max_memory", [&] {
    limited_spacing<2>(comm, line_of_sight(domain, *spacing_of(even)), spacing_of(even), 0.1,
                       {kManyNodes, 1e5});
  });
}

}  // namespace

int main(int argc, char** argv) {
  return rank_checks::run_in_groups(argc, argv, [] {
    for (const Case& c : cases()) check_case(c);
    check_volume();
    check_failures();
  });
}
