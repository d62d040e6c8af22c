// SPDX-License-Identifier: BSD-3-Clause
// The first row of inner nodes, with one node over each regular boundary edge.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "distorted_nodes.hpp"
#include "quality/plane/first_row.hpp"
#include "run_kernel_suite.hpp"

using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain;
using pnpbs::PopulationCounts;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using P = pnpbs::Point<2>;

namespace {

constexpr double kD = 0.03;
const Build kRing = [](PlaneDomain& p) {
  add_circle(p, 0.5, 0.5, 0.5);
  add_circle(p, 0.5, 0.5, 0.2);
};
const Build kSquareWithCircle = [](PlaneDomain& p) {
  add_loop(p, shapes::rectangle(0, 0, 1, 1));
  add_circle(p, 0.5, 0.5, 0.3, 1, pnpbs::CurveRole::inner);
};

LevelRun filled(const Build& build, const Plane& d) {
  LevelRun run(build, d);
  fill_level(*run.level);
  return run;
}

// Returns the third corner of the equilateral triangle over the edge (a, b), on its left or right
// side.
P apex_over(const P& a, const P& b, bool left) {
  const double angle = (left ? 1 : -1) * shapes::pi / 3, x = b[0] - a[0], y = b[1] - a[1];
  return {a[0] + std::cos(angle) * x - std::sin(angle) * y,
          a[1] + std::sin(angle) * x + std::cos(angle) * y};
}

std::int64_t inner_nodes_within(const Level& level, const P& x, double reach) {
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    count += level.nodes.moves(i) && pnpbs::distance<2>(level.nodes.position(i), x) < reach;
  return count;
}

// Calls visit(apex, edge length) for all edges, on the sides inside the domain.
template <class Visit>
void for_apexes(const Level& level, const Visit& visit) {
  for (const pnpbs::BoundaryEdge& e : level.geometry.boundary().facets) {
    const auto [a, b] = pnpbs::corners_of<2>(level.geometry.boundary(), e);
    const double length = pnpbs::distance<2>(a, b);
    if (e.left_inside) visit(apex_over(a, b, true), length);
    if (e.right_inside) visit(apex_over(a, b, false), length);
  }
}

std::int64_t occupied_apexes(const Level& level) {
  std::int64_t count = 0;
  for_apexes(level, [&](const P& apex, double length) {
    count += inner_nodes_within(level, apex, 1e-12 * length) == 1;
  });
  return count;
}

void expect_no_change(Level& level) {
  const PopulationCounts counts = pnpbs::place_first_row(level);
  ck_assert_int_eq(counts.inserted, 0);
  ck_assert_int_eq(counts.deleted, 0);
}

}  // namespace

// Each edge of a ring has its node, no other node is near that, and no other node is beside the
// boundary.
START_TEST(one_over_each_edge) {
  for (const Build& build : {kRing, kSquareWithCircle}) {
    LevelRun run = filled(build, constant(kD));
    Level& level = *run.level;
    const std::int64_t nodes = level.nodes.count;
    const PopulationCounts counts = pnpbs::place_first_row(level);
    ck_assert_int_gt(counts.inserted, 5);
    ck_assert_int_eq(level.nodes.count, nodes + counts.inserted - counts.deleted);
    std::set<std::int64_t> ids;
    for (std::int64_t i = 0; i < level.nodes.count; ++i) ids.insert(level.nodes.id(i));
    ck_assert_int_eq(std::ssize(ids), level.nodes.count);
    std::int64_t rows = 0;
    for_apexes(level, [&](const P& apex, double length) {
      if (std::min({apex[0], apex[1], 1 - apex[0], 1 - apex[1]}) < 0.1) return;
      ck_assert_int_eq(inner_nodes_within(level, apex, 1e-12 * length), 1);
      ck_assert_int_eq(inner_nodes_within(level, apex, 0.5 * length), 1);
      ++rows;
    });
    std::int64_t beside = 0;
    for (std::int64_t i = 0; i < level.nodes.count; ++i) {
      const P x = level.nodes.position(i);
      if (std::min({x[0], x[1], 1 - x[0], 1 - x[1]}) < 0.1) continue;
      beside += level.nodes.moves(i) && level.map().clearance(x, 1.15 * kD) < 1.15 * kD;
    }
    ck_assert_int_eq(beside, rows);
  }
}
END_TEST

// Sweeps leave the nodes of the row so near to the apexes that the row needs no change.
START_TEST(once_is_enough) {
  const Build lake = [](PlaneDomain& p) { add_lake(p, "lake_victoria"); };
  for (const auto& [build, d] : {std::pair{kRing, kD}, std::pair{lake, 3.0}}) {
    LevelRun run = filled(build, constant(d));
    run.steps(100);
    ck_assert_int_gt(pnpbs::place_first_row(*run.level).inserted, 5);
    expect_no_change(*run.level);
    for (int round = 0; round < 3; ++round) {
      pnpbs::sweep_and_repair(*run.level, 6);
      expect_no_change(*run.level);
    }
  }
}
END_TEST

// Edges at corners of a staircase, edges with a d that is too large, too small or too steep, and a
// strip with room for one row only get no row.
START_TEST(irregular_edges_have_none) {
  const Build steps = [](PlaneDomain& p) {
    shapes::Loop loop;
    for (int k = 0; k < 20; ++k)
      loop.xy.insert(loop.xy.end(), {kD * k, kD * k, kD * (k + 1), kD * k});
    loop.xy.insert(loop.xy.end(), {0.6, 0.6, 0, 0.6});
    add_loop(p, loop);
  };
  const Build polygon = [](PlaneDomain& p) { add_loop(p, shapes::circle(0, 0, 1, 60)); };
  const Build strip = [](PlaneDomain& p) { add_loop(p, shapes::rectangle(0, 0, 1, 2.1 * kD)); };
  const auto near_diagonal = [](const P& x) { return std::fabs(x[0] - x[1]) < 2 * kD; };
  {
    LevelRun run = filled(steps, constant(kD));
    pnpbs::place_first_row(*run.level);
    for_apexes(*run.level, [&](const P& apex, double length) {
      if (near_diagonal(apex))
        ck_assert_int_eq(inner_nodes_within(*run.level, apex, 1e-12 * length), 0);
    });
  }
  for (const double d : {0.15, 0.3}) {  // the sides are 0.1 long
    LevelRun run = filled(polygon, constant(d));
    expect_no_change(*run.level);
    ck_assert_int_eq(occupied_apexes(*run.level), 0);
  }
  LevelRun steep = filled(
      kRing, [](double x, double y) { return 0.01 + 0.9 * (0.5 - std::hypot(x - 0.5, y - 0.5)); });
  expect_no_change(*steep.level);
  LevelRun run = filled(strip, constant(kD));
  expect_no_change(*run.level);
  ck_assert_int_eq(occupied_apexes(*run.level), 0);
}
END_TEST

// An apex over a strait lies on land.
START_TEST(nodes_are_inside) {
  const Build strait = [](PlaneDomain& p) {
    add_loop(p, shapes::rectangle(0, 0, 1, 1));
    add_loop(p, shapes::rectangle(0.2, 0.03 * kD, 0.8, 0.5));
  };
  const Build lake = [](PlaneDomain& p) { add_lake(p, "lake_victoria"); };
  const Build lakes = [](PlaneDomain& p) { add_lake(p, "great_lakes_islands"); };
  for (const auto& [build, d] : {std::pair{strait, kD}, std::pair{lake, 3.0}, std::pair{lake, 10.0},
                                 std::pair{lakes, 8.0}}) {
    LevelRun run = filled(build, constant(d));
    pnpbs::place_first_row(*run.level);
    const Level& level = *run.level;
    for (std::int64_t i = 0; i < level.nodes.count; ++i) {
      const P x = level.nodes.position(i);
      if (level.nodes.moves(i))
        quick_assert_msg(level.map().inside(x) && level.map().clearance(x, d) > 0.35 * d,
                         "a node at (%.17g, %.17g)", x[0], x[1]);
    }
  }
}
END_TEST

// A curve that ends inside the domain has a row on both sides, but not at its ends.
START_TEST(curves_that_end_inside) {
  constexpr int kEdges = 20;
  const Build cut = [](PlaneDomain& p) {
    add_loop(p, shapes::rectangle(0, 0, 1, 1));
    add_chain(p, {0.2, 0.51, 0.2 + kEdges * kD, 0.51});
  };
  LevelRun run = filled(cut, constant(kD));
  pnpbs::place_first_row(*run.level);
  for (int k = 0; k < kEdges; ++k)
    for (const bool left : {false, true}) {
      const P apex = apex_over({0.2 + k * kD, 0.51}, {0.2 + (k + 1) * kD, 0.51}, left);
      const bool at_an_end = k == 0 || k == kEdges - 1;
      ck_assert_int_eq(inner_nodes_within(*run.level, apex, 1e-9 * kD), at_an_end ? 0 : 1);
    }
}
END_TEST

// Rows of bubbles slip along the boundary of a hole from which d grows.
START_TEST(boundary_triangles_are_good) {
  const Plane growing = [](double x, double y) {
    return 0.01 + 0.15 * (std::hypot(x - 0.5, y - 0.5) - 0.2);
  };
  const auto low_quality = [&](bool with_row) {
    LevelRun run = filled(kRing, growing);
    run.steps(200);
    if (with_row) pnpbs::place_first_row(*run.level);
    pnpbs::sweep_and_repair(*run.level, 6);
    run.renew_stars();
    const Level& level = *run.level;
    std::vector<double> beside;
    for (const Triangle& t : star_triangles(level)) {
      const auto [a, b, c] = t;
      if (level.nodes.moves(a) && level.nodes.moves(b) && level.nodes.moves(c)) continue;
      const P x = level.nodes.position(a), y = level.nodes.position(b), z = level.nodes.position(c);
      beside.push_back(std::fabs(quality(x, y, z)));
    }
    std::sort(beside.begin(), beside.end());
    ck_assert_int_gt(std::ssize(beside), 300);
    return beside[beside.size() / 50];
  };
  const double with = low_quality(true), without = low_quality(false);
  ck_assert_msg(with > 0.93 && without < 0.85, "98 %% are above %.3f, without the row %.3f", with,
                without);
}
END_TEST

TEST_SUITE(test_first_row) {
  return run_kernel_suite(
      "first_row", {one_over_each_edge, once_is_enough, irregular_edges_have_none, nodes_are_inside,
                    curves_that_end_inside, boundary_triangles_are_good});
}
