// SPDX-License-Identifier: BSD-3-Clause
// Tests initial nodes on surfaces over ranks: together they equal those of one process to the bit,
// while each rank evaluates d and creates nodes in its own part only.
#include "initial/volume/surface_fill.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "comm/records.hpp"
#include "geometry/surface_case.hpp"
#include "level/level.hpp"
#include "level/volume/surface_level.hpp"
#include "rank_checks.hpp"

namespace {

using pnpbs::BackgroundTree;
using pnpbs::SurfacePoint;
using rank_checks::comm;
using rank_checks::expect;
using space_shapes::P;
using space_shapes::SurfaceCase;

constexpr std::int64_t kMaxNodes = 1'000'000;

struct Case {
  const char* name;
  space_shapes::Shape shape;
  double (*d)(const P&);
};

// Counts of the work of a fill on a rank: evaluations of d and cells visited.
struct Work {
  std::int64_t points_asked = 0, places_looked_at = 0;
};

struct Fill {
  std::vector<SurfacePoint> nodes;
  Work work;
};

BackgroundTree<3> cells_of(const SurfaceCase& body, int depth) {
  BackgroundTree<3> tree;
  tree.build(body.bounds(),
             [&](const BackgroundTree<3>&, std::int32_t, std::int32_t, std::vector<char>& split) {
               if (depth-- > 0) std::fill(split.begin(), split.end(), 1);
             });
  return tree;
}

template <class Owns>
Fill fill(const pnpbs::Communicator& over, const SurfaceCase& body, double (*d)(const P&),
          const BackgroundTree<3>& cells, const Owns& owns, std::int64_t limit = kMaxNodes) {
  Fill made;
  // A spacing from nodes of an earlier placement is collective, so all ranks must make the same
  // calls.
  const auto spacing = [&](std::int64_t n, const P* x, double* values) {
    expect(over.same_on_all(0), "all ask for d together");
    made.work.points_asked += n;
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i]);
  };
  made.nodes = surface_fill(over, body.surface, spacing, limit, {cells, [&](std::int32_t cell) {
                                                                   ++made.work.places_looked_at;
                                                                   return owns(cell);
                                                                 }});
  return made;
}

std::vector<SurfacePoint> sorted(std::vector<SurfacePoint> nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const SurfacePoint& a, const SurfacePoint& b) {
    return std::tie(a.position, a.facet) < std::tie(b.position, b.facet);
  });
  return nodes;
}

std::vector<SurfacePoint> of_all_ranks(const std::vector<SurfacePoint>& mine) {
  pnpbs::Bytes bytes;
  for (const SurfacePoint& node : mine) pnpbs::pack(bytes, node);
  std::vector<SurfacePoint> all;
  pnpbs::for_records<SurfacePoint>(comm->allgather(bytes),
                                   [&](const SurfacePoint& node) { all.push_back(node); });
  return sorted(std::move(all));
}

void expect_same(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b,
                 const std::string& what) {
  expect(std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SurfacePoint& x, const SurfacePoint& y) {
                      return x.facet == y.facet && x.position == y.position;
                    }),
         what + ": the nodes of one process");
}

double constant(const P&) { return 0.04; }
double nearly_even(const P& x) { return 0.04 + 1e-3 * x[0]; }
double graded(const P& x) { return 0.03 + 0.02 * (x[0] + x[2]) * (x[0] + x[2]); }
double large(const P&) { return 9; }

// Returns flat and curved surfaces with constant and graded d, coarse facets, and a closed surface
// smaller than d.
std::vector<Case> cases() {
  using namespace space_shapes;
  return {{"ball", ball(4), constant},
          {"graded ball", ball(3), graded},
          {"turned cube", turned(cube(2), 0.3), constant},
          {"graded cube", cube(1), graded},
          {"nearly even cube", turned(cube(1), 0.3), nearly_even},
          {"cylinder", cylinder(48, 8, 2), nearly_even},
          {"grain", ball(2), large}};
}

// ------------------------------------------------------------------ nodes ----------------------

// Owners of cells are contiguous along the Morton order, or random.
int owner_in_a_row(std::int32_t cell, std::int32_t cells) {
  return static_cast<int>(std::int64_t{cell} * comm->size() / cells);
}
int any_owner(std::int32_t cell, std::int32_t) {
  return static_cast<int>(pnpbs::mixed(static_cast<std::uint64_t>(cell)) %
                          static_cast<std::uint64_t>(comm->size()));
}

void check_nodes(const Case& job, const SurfaceCase& body) {
  const auto serial = pnpbs::serial_communicator();
  const Fill whole =
      fill(*serial, body, job.d, cells_of(body, 0), [](std::int32_t) { return true; });
  const std::vector<SurfacePoint> wanted = sorted(whole.nodes);
  expect(wanted.size() >= 4, "there are nodes");
  for (const auto& [depth, owner] : {std::pair(1, &owner_in_a_row), std::pair(4, &any_owner)}) {
    const BackgroundTree<3> cells = cells_of(body, depth);
    const auto owns = [&, owner = owner](std::int32_t cell) {
      return owner(cell, cells.leaf_count()) == comm->rank();
    };
    const Fill own = fill(*comm, body, job.d, cells, owns);
    expect(std::all_of(own.nodes.begin(), own.nodes.end(),
                       [&](const SurfacePoint& x) { return owns(cells.leaf_at(x.position)); }),
           std::string(job.name) + ": a rank has nodes in its own cells only");
    expect_same(of_all_ranks(own.nodes), wanted, job.name);
  }
}

// ------------------------------------------------------------------ work -----------------------

// Checks that work is proportional to the own nodes of a rank. Exceptions are large facets before
// they are cut, and the border of its cells, which is an eighth of the body wide.
void check_work(const Case& job, const SurfaceCase& body) {
  const BackgroundTree<3> cells = cells_of(body, 3);
  const auto serial = pnpbs::serial_communicator();
  const Fill whole = fill(*serial, body, job.d, cells, [](std::int32_t) { return true; }),
             own = fill(*comm, body, job.d, cells, [&](std::int32_t cell) {
               return owner_in_a_row(cell, cells.leaf_count()) == comm->rank();
             });
  const auto part = [](std::int64_t mine, std::int64_t all) {
    return static_cast<double>(mine) / static_cast<double>(all);
  };
  const double share = part(std::ssize(own.nodes), std::ssize(whole.nodes)),
               asked = part(own.work.points_asked, whole.work.points_asked),
               looked_at = part(own.work.places_looked_at, whole.work.places_looked_at);
  if (comm->rank() == 0)
    std::printf("%s: %.3f of the nodes, %.3f of the points asked, %.3f of the places looked at\n",
                job.name, share, asked, looked_at);
  expect(asked < 1.2 * share + 0.05, std::string(job.name) + ": d is asked in a rank's own part");
  expect(looked_at < 1.5 * share + 0.2,
         std::string(job.name) + ": a rank looks at places in its own part");
}

// ------------------------------------------------------------------ errors ---------------------

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const pnpbs::Error& error) {
    return error.what();
  }
  return "";
}

void check_too_many(const Case& job, const SurfaceCase& body) {
  const auto serial = pnpbs::serial_communicator();
  const BackgroundTree<3> cells = cells_of(body, 3);
  const std::string wanted = error_of([&] {
    fill(
        *serial, body, job.d, cells, [](std::int32_t) { return true; }, 100);
  });
  expect(wanted.find("max_nodes allows 100") != std::string::npos, "too many nodes are an error");
  expect(error_of([&] {
           fill(
               *comm, body, job.d, cells,
               [&](std::int32_t cell) { return any_owner(cell, 0) == comm->rank(); }, 100);
         }) == wanted,
         std::string(job.name) + ": the same error on all ranks as in one process");
}

// ------------------------------------------------------------------ levels ---------------------

// Counts of the points at which d is evaluated for the first nodes on the sides of a box, and of
// the nodes.
struct Put {
  std::int64_t points_asked = 0, nodes = 0;
};

Put put_on_box(const std::shared_ptr<const pnpbs::Communicator>& over) {
  std::int64_t asked = 0;
  const auto d = std::make_shared<pnpbs::CallbackSpacing<3>>(
      [&asked](std::int64_t n, const double*, double* values) {
        asked += n;
        std::fill(values, values + n, 0.04);
        return 0;
      });
  const auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain->set_filled(false);
  domain->check();
  pnpbs::Timers timers(comm->seconds_waited());
  pnpbs::Level<3> level(over, domain, d, pnpbs::Settings(pnpbs::Options{}, 2), timers);
  level.grow_tree();
  const std::int64_t by_tree = asked;
  put_surface_nodes(level, {}, {}, true);
  return {asked - by_tree, level.owned_count()};
}

// Checks that a level fills only the part of the surfaces that the rank owns.
void check_level() {
  const Put whole = put_on_box(pnpbs::serial_communicator()), own = put_on_box(comm);
  const double size = comm->size();
  const auto share = static_cast<double>(own.nodes) / static_cast<double>(whole.nodes),
             asked =
                 static_cast<double>(own.points_asked) / static_cast<double>(whole.points_asked);
  expect(comm->allreduce_sum(static_cast<std::uint64_t>(own.nodes)) ==
             static_cast<std::uint64_t>(whole.nodes),
         "all nodes of a level");
  if (comm->rank() == 0)
    std::printf("level: %.3f of the nodes, %.3f of the points asked\n", share, asked);
  expect(asked < 1.5 * share + 0.1 && asked < 1.5 / size + 0.1, "a level fills its own part");
}

void check_all() {
  check_level();
  for (const Case& job : cases()) {
    const SurfaceCase body(job.shape.mesh());
    check_nodes(job, body);
    if (job.d == large) continue;
    check_work(job, body);
    check_too_many(job, body);
  }
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
