// SPDX-License-Identifier: BSD-3-Clause
// Finishing sweeps: their improvements, and the guard against worse triangles.
#include <algorithm>
#include <cmath>
#include <vector>

#include "distorted_nodes.hpp"
#include "run_kernel_suite.hpp"

using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

double mean_quality(const std::vector<Triangle>& triangles, const Places& places) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += quality_of(t, places);
  return sum / static_cast<double>(triangles.size());
}

// Returns distorted nodes with settings for sweeps with this guard and without repairs.
LevelRun sweep_only(const Shape& shape, std::uint64_t seed, double bad_below) {
  return distorted(shape.build, shape.d, seed, [&](pnpbs::Settings& s) {
    s.sweep.bad_below = bad_below;
    s.repair.rounds = 0;
  });
}

// Counts triangles that are bad after this number of sweeps over the same stars, and were better
// before.
std::int64_t spoilt(const Shape& shape, std::uint64_t seed, std::int64_t sweeps, double bad_below,
                    double limit) {
  LevelRun run = sweep_only(shape, seed, bad_below);
  const std::vector<Triangle> triangles = triangles_by_id(*run.level);
  const Places before = places_by_id(*run.level);
  pnpbs::sweep_and_repair(*run.level, sweeps);
  const Places after = places_by_id(*run.level);
  ck_assert_double_gt(mean_quality(triangles, after), mean_quality(triangles, before) + 0.002);
  return std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const double quality_after = quality_of(t, after);
    return quality_after < limit - 1e-12 && quality_after < quality_of(t, before) - 1e-12;
  });
}

}  // namespace

START_TEST(no_bad_triangle_gets_worse) {
  const double limit = pnpbs::SweepRule{}.bad_below;
  std::uint64_t seed = 100;
  std::int64_t without_guard = 0;
  for (const Shape& shape : shapes_to_finish())
    for (const std::int64_t sweeps : {1, 5}) {
      ck_assert_int_eq(spoilt(shape, ++seed, sweeps, limit, limit), 0);
      without_guard += spoilt(shape, seed, sweeps, -2, limit);
    }
  ck_assert_int_gt(without_guard, 20);  // so the guard had an effect
}
END_TEST

// An inner node moves 0.6 of the way to the mean of its neighbours if all triangles are good.
START_TEST(nodes_go_towards_the_mean) {
  const Plane d = constant(0.05);
  const Build square = [](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); };
  LevelRun fill(square, d);
  fill_level(*fill.level);
  pnpbs::IncomingNodes<2> nodes = inner_nodes_of(*fill.level);
  Random random(110);
  for (pnpbs::IncomingNode<2>& node : nodes)
    for (double& x : node.position) x += random.between(-0.04, 0.04) * 0.05;
  LevelRun run(square, d, {{"smoothing_rounds", "0"}});
  pnpbs::take(*run.level, nodes, 0);
  run.renew_stars();
  const Level& level = *run.level;
  std::map<std::int64_t, P> expected;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    const P x = level.nodes.position(i);
    if (level.nodes.moves(i) && level.map().clearance(x, 0.1) < 0.1) continue;
    P mean{};
    double n = 0;
    level.stars.for_neighbours(i, [&](std::int64_t j) {
      for (const int k : {0, 1}) mean[k] += level.nodes.x[k](j);
      ++n;
    });
    P goal = x;
    for (const int k : {0, 1})
      if (level.nodes.moves(i)) goal[k] += 0.6 * (mean[k] / n - x[k]);
    expected[level.nodes.id(i)] = goal;
  }
  pnpbs::sweep_and_repair(*run.level, 1);
  ck_assert_uint_gt(expected.size(), 300);
  const Places after = places_by_id(level);
  for (const auto& [id, goal] : expected)
    ck_assert_double_lt(pnpbs::distance<2>(after.at(id), goal), 1e-15);
}
END_TEST

// No sweep moves a node by more than 0.1 d, across the boundary, or too near to it.
START_TEST(sweeps_move_a_little_and_keep_off) {
  std::uint64_t seed = 120;
  for (const Shape& shape : shapes_to_finish()) {
    LevelRun run = sweep_only(shape, ++seed, 0.75);
    for (int round = 0; round < 12; ++round) {
      const Places before = places_by_id(*run.level);
      pnpbs::sweep_and_repair(*run.level, 1);
      for (std::int64_t i = 0; i < run.level->nodes.count; ++i) {
        const P x = run.level->nodes.position(i), from = before.at(run.level->nodes.id(i));
        const double d = run.level->nodes.d(i);
        if (!run.level->nodes.moves(i) || x == from) {
          quick_assert(x == from);
          continue;
        }
        quick_assert(run.level->map().inside(x));
        if (run.level->map().clearance(from, d) > 0.6 * d)
          ck_assert_double_le(pnpbs::distance<2>(x, from), 0.1 * d * (1 + 1e-12));
        ck_assert_double_ge(run.level->map().clearance(x, d), 0.35 * d * (1 - 1e-12));
      }
    }
  }
}
END_TEST

START_TEST(sweeping_nothing_does_nothing) {
  LevelRun run = sweep_only(shapes_to_finish()[0], 130, 0.75);
  const Places before = places_by_id(*run.level);
  pnpbs::sweep_and_repair(*run.level, 0);
  quick_assert(places_by_id(*run.level) == before);
}
END_TEST

TEST_SUITE(test_sweep) {
  return run_kernel_suite("sweep",
                          {no_bad_triangle_gets_worse, nodes_go_towards_the_mean,
                           sweeps_move_a_little_and_keep_off, sweeping_nothing_does_nothing});
}
