// SPDX-License-Identifier: BSD-3-Clause
// Repair of the last defects: surplus nodes and bad triangles.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "distorted_nodes.hpp"
#include "quality/plane/bad_triangles.hpp"
#include "quality/plane/surplus_nodes.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::DelaunayStars;
using IncomingNode = pnpbs::IncomingNode<2>;
using IncomingNodes = pnpbs::IncomingNodes<2>;
using Level = pnpbs::Level<2>;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

const Build kSquare = [](pnpbs::PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); };
constexpr double kD = 0.05;

// Returns a level with the inner nodes of a lattice and additional nodes. The ids of the latter
// begin with kMore, those of boundary nodes with kBoundary.
constexpr std::int64_t kMore = 100000, kBoundary = 200000;
LevelRun lattice_with(const std::vector<P>& more) {
  LevelRun fill(kSquare, constant(kD));
  fill_level(*fill.level);
  IncomingNodes nodes = inner_nodes_of(*fill.level);
  std::int64_t id = kMore;
  for (const P& x : more) nodes.push_back({x, id++});
  LevelRun run(kSquare, constant(kD));
  ck_assert_int_eq(pnpbs::take(*run.level, nodes, kBoundary).thinned, 0);
  run.renew_stars();
  return run;
}

// Returns the midpoint of a lattice edge: from the node nearest to a point, approximately in this
// direction.
P middle_of_edge(const P& near, double angle) {
  const LevelRun run = lattice_with({});
  const pnpbs::Nodes<2>& nodes = run.level->nodes;
  const auto nearest_to = [&](const P& x) {
    std::int64_t best = 0;
    for (std::int64_t i = 1; i < nodes.count; ++i)
      if (pnpbs::distance<2>(nodes.position(i), x) < pnpbs::distance<2>(nodes.position(best), x))
        best = i;
    return nodes.position(best);
  };
  const P a = nearest_to(near);
  const P b = nearest_to({a[0] + kD * std::cos(angle), a[1] + kD * std::sin(angle)});
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

std::int64_t nodes_added(const Level& level) {
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    count += level.nodes.id(i) >= kMore && level.nodes.id(i) < kBoundary;
  return count;
}

// Returns the shape measure of a triangle from its angles.
double shape_of(const Triangle& t, const Places& places) {
  const P a = places.at(t[0]), b = places.at(t[1]), c = places.at(t[2]);
  const auto angle = [](const P& at, const P& u, const P& w) {
    const double cross = (u[0] - at[0]) * (w[1] - at[1]) - (u[1] - at[1]) * (w[0] - at[0]);
    const double dot = (u[0] - at[0]) * (w[0] - at[0]) + (u[1] - at[1]) * (w[1] - at[1]);
    return std::atan2(cross, dot);
  };
  const double min = std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
  return std::min(quality(a, b, c), 1.365 * std::sin(min));
}

}  // namespace

START_TEST(node_in_the_middle_of_an_edge_goes) {
  for (const double angle : {0.0, 1.05, 2.09}) {
    LevelRun run = lattice_with({middle_of_edge({0.3, 0.4}, angle), middle_of_edge({0.6, 0.7}, 0)});
    const std::int64_t nodes = run.level->nodes.count;
    ck_assert_int_eq(pnpbs::sweep_and_repair(*run.level, 0).counts.deleted, 2);
    ck_assert_int_eq(run.level->nodes.count, nodes - 2);
    ck_assert_int_eq(nodes_added(*run.level), 0);
  }
}
END_TEST

// The stars after the removal are those of the lattice.
START_TEST(stars_close_over_the_hole) {
  const LevelRun lattice = lattice_with({});
  LevelRun run = lattice_with({middle_of_edge({0.3, 0.4}, 0), middle_of_edge({0.6, 0.7}, 1.05)});
  DelaunayStars stars = run.level->stars;
  const std::vector<std::int32_t> surplus = pnpbs::remove_surplus_nodes(run.level->nodes, stars);
  ck_assert_uint_eq(surplus.size(), 2);
  const auto triangles = [](const Level& level, const DelaunayStars& of) {
    std::multiset<std::array<std::int64_t, 3>> all;  // once from each corner
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      of.for_simplices(i, [&](const DelaunayStars::Corners& others) {
        all.insert({level.nodes.id(i), level.nodes.id(others[0]), level.nodes.id(others[1])});
      });
    return all;
  };
  quick_assert(triangles(*run.level, stars) == triangles(*lattice.level, lattice.level->stars));
  for (const std::int32_t i : surplus) {
    ck_assert_int_eq(stars.size(i), 0);
    quick_assert(!stars.closed(i));
  }
}
END_TEST

// Two additional nodes on one edge are neighbours, and both have four neighbours.
START_TEST(neighbours_do_not_both_go) {
  const P middle = middle_of_edge({0.4, 0.5}, 0);
  LevelRun run = lattice_with({{middle[0] - kD / 6, middle[1]}, {middle[0] + kD / 6, middle[1]}});
  DelaunayStars stars = run.level->stars;
  int few = 0;
  for (std::int64_t i = 0; i < run.level->nodes.count; ++i)
    few += stars.closed(i) && stars.size(i) <= 4;
  ck_assert_int_eq(few, 2);
  ck_assert_uint_eq(pnpbs::remove_surplus_nodes(run.level->nodes, stars).size(), 0);
}
END_TEST

// A node at the centre of a square of nodes has four good triangles and stays.
START_TEST(good_node_with_four_neighbours_stays) {
  IncomingNodes nodes;
  const double d = 0.25;
  for (int i = 1; i < 4; ++i)
    for (int j = 1; j < 4; ++j) nodes.push_back({{d * i, d * j}, 3 * i + j});
  const std::size_t corners = nodes.size();
  nodes.push_back({{1.5 * d, 1.5 * d}, 100});
  nodes.push_back({{2.5 * d, 2.5 * d}, 101});
  LevelRun run(kSquare, constant(d));
  pnpbs::take(*run.level, nodes, 200);
  run.renew_stars();
  DelaunayStars stars = run.level->stars;
  std::int64_t with_four = 0;
  for (std::int64_t i = 0; i < run.level->nodes.count; ++i)
    with_four += run.level->nodes.id(i) >= 100 && stars.size(i) == 4;
  ck_assert_uint_eq(corners, 9);
  ck_assert_int_gt(with_four, 0);
  ck_assert_uint_eq(pnpbs::remove_surplus_nodes(run.level->nodes, stars).size(), 0);
}
END_TEST

START_TEST(shape_by_the_angles) {
  Random random(150);
  for (int n = 0; n < 1000; ++n) {
    Places places;
    for (std::int64_t k = 0; k < 3; ++k) places[k] = {random.between(0, 1), random.between(0, 1)};
    Triangle t{0, 1, 2};
    if (pnpbs::orientation(places[0], places[1], places[2]) < 0) t = {0, 2, 1};
    const double shape = pnpbs::triangle_shape(places[t[0]], places[t[1]], places[t[2]]);
    ck_assert_double_eq_tol(shape, shape_of(t, places), 1e-9);
    ck_assert_double_lt(pnpbs::triangle_shape(places[t[0]], places[t[2]], places[t[1]]), 0);
  }
}
END_TEST

// No bad triangle gets worse, no good one becomes bad, and nearly every worst one improves.
START_TEST(bad_triangles_get_better) {
  std::uint64_t seed = 160;
  for (const Shape& shape : shapes_to_finish()) {
    LevelRun run = distorted(shape.build, shape.d, ++seed, {});
    pnpbs::sweep_and_repair(*run.level, 3);  // leaves few bad triangles
    run.renew_stars();
    const double bad = run.level->settings.repair.bad_below;
    const std::vector<Triangle> triangles = triangles_by_id(*run.level);
    const Places before = places_by_id(*run.level);
    pnpbs::BadTriangleRepair repair(run.level->nodes, run.level->stars,
                                    run.level->neighbourhood.near_boundary().edges(),
                                    run.level->map(), pnpbs::measure_by_shape(bad));
    std::int64_t moved = 0;
    for (int round = 0; round < 10; ++round) moved += repair.round();
    const Places after = places_by_id(*run.level);
    double exclusive_scan = 0, sum_after = 0;
    for (const Triangle& t : triangles) {
      const double was = shape_of(t, before), is = shape_of(t, after);
      ck_assert_double_ge(is, std::min(was, bad) - 1e-9);
      exclusive_scan += std::max(0.0, bad - was);
      sum_after += std::max(0.0, bad - is);
    }
    ck_assert_int_gt(moved, 5);
    ck_assert_double_lt(sum_after, 0.8 * exclusive_scan);
  }
}
END_TEST

// The repair moves only nodes of bad triangles, and keeps them off the boundary.
START_TEST(repair_leaves_the_rest_alone) {
  std::uint64_t seed = 170;
  for (const Shape& shape : shapes_to_finish()) {
    LevelRun run = distorted(shape.build, shape.d, ++seed, {});
    const double bad = run.level->settings.repair.bad_below;
    const Places before = places_by_id(*run.level);
    std::set<std::int64_t> of_bad;
    for (const Triangle& t : triangles_by_id(*run.level))
      if (shape_of(t, before) < bad + 1e-9) of_bad.insert(t.begin(), t.end());
    pnpbs::BadTriangleRepair repair(run.level->nodes, run.level->stars,
                                    run.level->neighbourhood.near_boundary().edges(),
                                    run.level->map(), pnpbs::measure_by_shape(bad));
    ck_assert_int_gt(repair.round(), 0);
    const pnpbs::Nodes<2>& nodes = run.level->nodes;
    for (std::int64_t i = 0; i < nodes.count; ++i) {
      if (nodes.position(i) == before.at(nodes.id(i))) continue;
      quick_assert(nodes.moves(i));
      quick_assert(of_bad.count(nodes.id(i)) == 1);
      quick_assert(run.level->map().inside(nodes.position(i)));
      ck_assert_double_ge(run.level->map().clearance(nodes.position(i), nodes.d(i)),
                          0.35 * nodes.d(i) * (1 - 1e-12));
    }
  }
}
END_TEST

// A higher bound makes more triangles count as bad, which could block the improvement of the worst
// ones. Therefore the worst ones are repaired first.
START_TEST(a_higher_bound_costs_the_worst_nothing) {
  std::uint64_t seed = 190;
  for (const Shape& shape : shapes_to_finish()) {
    const auto min_with = [&](double bad_below) {
      LevelRun run = distorted(shape.build, shape.d, seed, [&](pnpbs::Settings& settings) {
        settings.repair.bad_below = bad_below;
      });
      run.renew_stars();
      const std::vector<Triangle> triangles = triangles_by_id(*run.level);
      pnpbs::sweep_and_repair(*run.level, 3);
      const Places places = places_by_id(*run.level);
      double min = 1;
      for (const Triangle& t : triangles)
        if (places.count(t[0]) * places.count(t[1]) * places.count(t[2]) > 0)
          min = std::min(min, shape_of(t, places));
      return min;
    };
    ++seed;
    const double min = min_with(pnpbs::RepairRule{}.worst_below);
    ck_assert_double_ge(min_with(0.95), min - 1e-9);
  }
}
END_TEST

TEST_SUITE(test_repair) {
  return run_kernel_suite(
      "repair",
      {node_in_the_middle_of_an_edge_goes, stars_close_over_the_hole, neighbours_do_not_both_go,
       good_node_with_four_neighbours_stays, shape_by_the_angles, bad_triangles_get_better,
       repair_leaves_the_rest_alone, a_higher_bound_costs_the_worst_nothing});
}
