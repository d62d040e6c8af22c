// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes: hexagonal for constant d, and with the expected number for variable d.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "level_run.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::PlaneDomain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

struct Filled {
  PlaneDomain domain;
  pnpbs::Boundary boundary;
  pnpbs::SizedTree<2> map;
  std::vector<P> nodes;

  Filled(const Build& build, const Plane& d) {
    build(domain);
    domain.check();
    boundary = pnpbs::discretize_boundary(domain, evaluator_of(d));
    map.build(domain.bounds(), boundary, evaluator_of(d), 1'000'000'000);
    const auto all = [](std::int32_t) { return true; };
    nodes = pnpbs::lattice_fill<2>(map, domain.bounds(), all);
    fill_steep_leaves(pnpbs::GradedFill<2>(map, all), d);
  }

  void fill_steep_leaves(const pnpbs::GradedFill<2>& fill, const Plane& d) {
    std::vector<double> values;
    for (const P& x : fill.centres()) values.push_back(d(x[0], x[1]));
    std::vector<std::int64_t> before = fill.wanted_nodes(values);
    std::exclusive_scan(before.begin(), before.end(), before.begin(), std::int64_t{0});
    for (const P& x : fill.place(values, before)) nodes.push_back(x);
  }
  Filled(const Filled&) = delete;

  double gap_to_boundary(const P& x) const {
    double min = std::numeric_limits<double>::infinity();
    for (const pnpbs::BoundaryEdge& e : boundary.facets) {
      const P a = boundary.nodes[e.begin].position, b = boundary.nodes[e.end].position;
      const double ux = b[0] - a[0], uy = b[1] - a[1];
      const double t =
          std::clamp(((x[0] - a[0]) * ux + (x[1] - a[1]) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
      min = std::min(min, std::hypot(x[0] - a[0] - t * ux, x[1] - a[1] - t * uy));
    }
    return min;
  }
};

void add_ring(PlaneDomain& domain) {
  add_circle(domain, 0.3, -0.2, 1);
  add_circle(domain, 0.5, -0.1, 0.31);
}

// Expects six neighbours of inner nodes far from the boundary. Their distances are at most d plus
// the stretch that fits the lattice to the box of the domain.
void expect_hexagonal(const Build& build, double d, double stretch) {
  const Filled filled(build, constant(d));
  std::int64_t inner = 0;
  for (const P& x : filled.nodes) {
    quick_assert(filled.map.inside(x));
    const double gap = filled.gap_to_boundary(x);
    ck_assert_double_ge(gap, 0.5 * d * (1 - 1e-12));
    if (gap < 2 * d) continue;
    ++inner;
    int neighbours = 0;
    for (const P& y : filled.nodes) {
      const double way = pnpbs::distance<2>(x, y);
      if (way == 0 || way > 1.4 * d) continue;
      ++neighbours;
      ck_assert_double_eq_tol(way, d, stretch * d);
    }
    ck_assert_int_eq(neighbours, 6);
  }
  ck_assert_int_gt(inner, 300);
}

// Returns the expected number of nodes, integrated over the points at least d/2 from the boundary.
double meant(const Filled& filled, const Plane& d) {
  const pnpbs::Box<2> box = filled.domain.bounds();
  constexpr int kFine = 1000;
  const double dx = (box.high[0] - box.low[0]) / kFine, dy = (box.high[1] - box.low[1]) / kFine;
  double sum = 0;
  for (int i = 0; i < kFine; ++i)
    for (int j = 0; j < kFine; ++j) {
      const P x{box.low[0] + (i + 0.5) * dx, box.low[1] + (j + 0.5) * dy};
      const double value = d(x[0], x[1]);
      if (!filled.map.inside(x) || filled.map.clearance(x, value) < 0.5 * value) continue;
      sum += 2 / std::sqrt(3.0) / (value * value);
    }
  return sum * dx * dy;
}

void expect_meant(const Build& build, const Plane& d, std::size_t min_nodes) {
  const Filled filled(build, d);
  ck_assert_uint_gt(filled.nodes.size(), min_nodes);
  const double expected = meant(filled, d);
  ck_assert_double_eq_tol(static_cast<double>(filled.nodes.size()), expected, 0.02 * expected);
  for (const P& x : filled.nodes) {
    quick_assert(filled.map.inside(x));
    ck_assert_double_ge(filled.map.clearance(x, d(x[0], x[1])), 0.4 * d(x[0], x[1]));
  }
  // Adjacent patches have no node in common.
  std::vector<P> sorted = filled.nodes;
  std::sort(sorted.begin(), sorted.end());
  quick_assert(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
}

}  // namespace

START_TEST(hexagonal_where_d_is_constant) {
  // 1.37 and 0.93 are 45.7 steps and 35.8 rows, stretched to 46 and 36.
  expect_hexagonal([](PlaneDomain& p) { add_loop(p, rectangle(-0.2, 0.1, 1.17, 1.03)); }, 0.03,
                   0.012);
  expect_hexagonal(add_ring, 0.04, 0.02);
  expect_hexagonal([](PlaneDomain& p) { add_lake(p, "lake_victoria"); }, 5, 0.03);
}
END_TEST

// This box fits the lattice without stretching, so distances equal d.
START_TEST(exactly_hexagonal) {
  const double height = 0.04 * std::sqrt(0.75) * 30;
  expect_hexagonal([=](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1.2, height)); }, 0.04, 1e-12);
}
END_TEST

START_TEST(as_many_as_d_means) {
  const Build square = [](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); };
  expect_meant(square, constant(0.011), 7000);
  expect_meant(add_ring, constant(0.016), 8000);
  expect_meant(
      square,
      [](double x, double y) { return 0.003 * (1 + 9 * std::hypot(x - 0.5, y - 0.5) / 0.7071); },
      5000);
  expect_meant(
      add_ring, [](double x, double y) { return 0.01 + 0.015 * std::fabs(x + y); }, 8000);
  expect_meant([](PlaneDomain& p) { add_lake(p, "great_lakes"); },
               [](double x, double y) { return 1.5 + 0.02 * std::hypot(x, y); }, 5000);
}
END_TEST

// d grows by a fifth of the distance. The number of nodes must match d in every band of a factor of
// two.
START_TEST(steep_spacings_are_met_from_band_to_band) {
  const auto d = [](double y) { return 0.001 + 0.2 * std::fabs(y - 0.4371); };
  LevelRun run([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); },
               [&](double, double y) { return d(y); });
  fill_level(*run.level);
  const pnpbs::Nodes<2>& nodes = run.level->nodes;
  for (double from = 0.001; from < 0.06; from *= 2) {
    double wanted = 0, placed = 0;
    constexpr int kFine = 100000;
    for (int k = 0; k < kFine; ++k) {
      const double there = d((k + 0.5) / kFine);
      if (there >= from && there < 2 * from) wanted += 2 / std::sqrt(3.0) / (there * there) / kFine;
    }
    for (std::int64_t i = 0; i < nodes.count; ++i)
      placed += nodes.d(i) >= from && nodes.d(i) < 2 * from;
    // Bands are a few nodes wide, and nodes on the sides of the square count fully.
    ck_assert_double_eq_tol(placed, wanted, 0.06 * wanted + 4);
  }
}
END_TEST

// Lattices with nodes on the borders of leaves, up to rounding. Each node is created only by the
// leaf that leaf_at returns, which also determines its id and its rank.
START_TEST(each_leaf_makes_its_own) {
  for (const double d : {0.05, 0.0625, 0.0697, 0.07, 0.0714, 0.08, 0.1}) {
    const Filled filled([](PlaneDomain& p) { add_loop(p, rectangle(-1, -1, 1, 1)); }, constant(d));
    std::size_t made = 0;
    for (std::int32_t leaf = 0; leaf < filled.map.tree().leaf_count(); ++leaf) {
      const std::vector<P> own = pnpbs::lattice_fill<2>(
          filled.map, filled.domain.bounds(), [leaf](std::int32_t other) { return other == leaf; });
      for (const P& x : own) ck_assert_int_eq(filled.map.tree().leaf_at(x), leaf);
      made += own.size();
    }
    ck_assert_uint_eq(made, filled.nodes.size());
    std::vector<P> sorted = filled.nodes;
    std::sort(sorted.begin(), sorted.end());
    quick_assert(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
  }
}
END_TEST

START_TEST(no_room_for_any) {
  const Filled strip([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 0.09)); }, constant(0.1));
  quick_assert(strip.nodes.empty());
  const Filled coarse([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); }, constant(50));
  quick_assert(coarse.nodes.empty());
}
END_TEST

// Properties of the nodes of a filled level: ids in the order of memory, boundary nodes, d and
// tags.
START_TEST(levels_number_their_nodes) {
  LevelRun run(add_ring, [](double x, double) { return 0.05 + 0.02 * x; });
  fill_level(*run.level);
  const pnpbs::Nodes<2>& nodes = run.level->nodes;
  std::int64_t laid = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    ck_assert_int_eq(nodes.id(i), i);
    quick_assert(nodes.d(i) == 0.05 + 0.02 * nodes.x[0](i));
    quick_assert(nodes.v[0](i) == 0 && nodes.v[1](i) == 0);
    if (nodes.moves(i)) {
      ck_assert_int_eq(nodes.tag(i), 0);
      continue;
    }
    const pnpbs::BoundaryNode<2>& node =
        run.level->geometry.boundary().nodes[nodes.boundary_node(i)];
    quick_assert(nodes.position(i) == node.position);
    ck_assert_int_eq(nodes.tag(i), node.tag);
    ++laid;
  }
  ck_assert_int_eq(laid, run.level->geometry.boundary_nodes());
  ck_assert_int_eq(run.level->next_id, nodes.count);
}
END_TEST

// Ids that doubles cannot represent: ids of new nodes are still larger.
START_TEST(large_ids_stay_unique) {
  constexpr std::int64_t kLarge = (std::int64_t{1} << 53) + 1;
  for (const std::int64_t id : {kLarge, kLarge + 1, std::int64_t{1} << 62}) {
    LevelRun run([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); }, constant(0.1));
    pnpbs::take(*run.level, {{{0.5, 0.5}, id}, {{0.2, 0.3}, id - 1}}, 0);
    const pnpbs::Nodes<2>& nodes = run.level->nodes;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (!nodes.moves(i)) ck_assert_int_gt(nodes.id(i), id);
  }
}
END_TEST

// Given nodes keep their ids, new nodes have larger ones, and nodes that do not fit are left out.
START_TEST(levels_take_given_nodes) {
  LevelRun run([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); }, constant(0.1));
  const std::int64_t left_out = pnpbs::take(*run.level,
                                            {{{0.5, 0.5}, 700},
                                             {{0.05, 0.5}, -1},
                                             {{0.03, 0.5}, 12},
                                             {{1.5, 0.5}, 13},
                                             {{0.5, 0}, 14},
                                             {{0.2, 0.3}, 5}},
                                            0)
                                    .left_out;
  ck_assert_int_eq(left_out, 3);
  const pnpbs::Nodes<2>& nodes = run.level->nodes;
  ck_assert_int_eq(nodes.count, 40 + 3);
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (nodes.position(i) == P{0.5, 0.5})
      ck_assert_int_eq(nodes.id(i), 700);
    else if (nodes.position(i) == P{0.2, 0.3})
      ck_assert_int_eq(nodes.id(i), 5);
    else
      ck_assert_int_gt(nodes.id(i), 700);
    for (std::int64_t j = 0; j < i; ++j) quick_assert(nodes.id(i) != nodes.id(j));
  }
}
END_TEST

TEST_SUITE(test_initial_fill) {
  return run_kernel_suite(
      "initial_fill",
      {hexagonal_where_d_is_constant, exactly_hexagonal, as_many_as_d_means,
       steep_spacings_are_met_from_band_to_band, each_leaf_makes_its_own, no_room_for_any,
       levels_number_their_nodes, large_ids_stay_unique, levels_take_given_nodes});
}
