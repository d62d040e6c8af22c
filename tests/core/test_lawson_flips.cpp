// SPDX-License-Identifier: BSD-3-Clause
// Stars restored by flips after nodes moved equal newly built stars, in the same order. Otherwise
// the restoration is abandoned, and only for a valid reason.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hard_shapes.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using hard_shapes::add_square;
using hard_shapes::graded;
using hard_shapes::small_shapes;
using Level = pnpbs::Level<2>;

namespace {

// Neighbours by id, and whether a triangle follows each.
using Star = std::vector<std::pair<std::int64_t, bool>>;
using StarsById = std::map<std::int64_t, Star>;

StarsById stars_of(const Level& level) {
  StarsById stars;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    level.stars.for_neighbours_in_order(i, [&](std::int64_t j, bool triangle) {
      stars[level.nodes.id(i)].emplace_back(level.nodes.id(j), triangle);
    });
  return stars;
}

StarsById found_anew(Level& level) {
  pnpbs::rebuild_lists(level, 1.7);
  pnpbs::rebuild_stars(level);
  return stars_of(level);
}

// Counts the stars whose sets of neighbours differ.
std::int64_t stars_with_others(const StarsById& a, const StarsById& b) {
  const auto sorted = [](Star star) {
    std::sort(star.begin(), star.end());
    return star;
  };
  return std::count_if(a.begin(), a.end(), [&](const auto& star) {
    return sorted(star.second) != sorted(b.at(star.first));
  });
}

// Moves every `every`-th free node by up to `by` times d in each direction.
void shake(Level& level, Random& random, double by, std::int64_t every = 1) {
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    if (!level.nodes.moves(i) || level.nodes.id(i) % every != 0) continue;
    pnpbs::Point<2> x = level.nodes.position(i);
    for (int k = 0; k < 2; ++k) x[k] += random.between(-by, by) * level.nodes.d(i);
    level.nodes.set_position(i, x);
  }
  level.nodes.moved();
}

// Returns how many stars have other neighbours than before, or -1 if the restoration was abandoned.
std::int64_t expect_as_found_anew(const std::string& what, Level& level) {
  const StarsById before = stars_of(level);
  const bool restored = pnpbs::restore_stars(level);
  const StarsById after = stars_of(level), anew = found_anew(level);
  if (!restored) return -1;
  for (const auto& [id, star] : anew)
    quick_assert_msg(after.at(id) == star, "%s: the star of node %lld is not as found anew",
                     what.c_str(), static_cast<long long>(id));
  ck_assert_uint_eq(after.size(), anew.size());
  return stars_with_others(before, after);
}

void settle(LevelRun& run) {
  fill_level(*run.level);
  run.steps(100);
}

}  // namespace

START_TEST(after_sweeps) {
  for (const hard_shapes::Shape& shape : small_shapes()) {
    LevelRun run(shape.build, graded(shape.d));
    settle(run);
    pnpbs::sweep_and_repair(*run.level, 6);
    ck_assert_int_ge(expect_as_found_anew(shape.name, *run.level), 0);
  }
}
END_TEST

START_TEST(after_nodes_moved_a_little) {
  Random random(91);
  std::int64_t changed = 0, given_up = 0;
  for (const hard_shapes::Shape& shape : small_shapes()) {
    LevelRun run(shape.build, graded(shape.d));
    settle(run);
    found_anew(*run.level);
    for (const double by : {0.001, 0.01, 0.03, 0.1, 1.0}) {
      shake(*run.level, random, by);
      const std::int64_t others =
          expect_as_found_anew(shape.name + (" shaken by " + std::to_string(by)), *run.level);
      changed += std::max<std::int64_t>(others, 0);
      given_up += others < 0;
      if (by < 0.01) ck_assert_int_ge(others, 0);
    }
  }
  ck_assert_int_gt(changed, 100);
  ck_assert_int_gt(given_up, 0);
}
END_TEST

// Many flips around the same nodes.
START_TEST(after_few_nodes_moved_far) {
  Random random(92);
  LevelRun run(add_square, graded(0.02));
  settle(run);
  std::int64_t changed = 0;
  for (int round = 0; round < 50; ++round) {
    found_anew(*run.level);
    shake(*run.level, random, 0.4, 149);
    changed += std::max<std::int64_t>(expect_as_found_anew("few nodes", *run.level), 0);
  }
  ck_assert_int_gt(changed, 30);
}
END_TEST

// The four nodes of each cell lie on a circle, and each node has four equally near neighbours.
START_TEST(to_an_exact_grid) {
  constexpr int kCells = 32;
  LevelRun run(add_square, constant(1.0 / kCells));
  pnpbs::IncomingNodes<2> nodes;
  for (int a = 1; a < kCells; ++a)
    for (int b = 1; b < kCells; ++b)
      nodes.push_back({{static_cast<double>(a) / kCells, static_cast<double>(b) / kCells}, -1});
  pnpbs::take(*run.level, nodes, 0);
  found_anew(*run.level);
  Random random(93);
  std::int64_t changed = 0;
  for (int round = 0; round < 20; ++round) {
    std::map<std::int64_t, pnpbs::Point<2>> grid;
    pnpbs::Nodes<2>& at = run.level->nodes;
    for (std::int64_t i = 0; i < at.count; ++i) grid[at.id(i)] = at.position(i);
    shake(*run.level, random, 0.1, 97);
    found_anew(*run.level);
    for (std::int64_t i = 0; i < at.count; ++i) at.set_position(i, grid[at.id(i)]);
    at.moved();
    const std::int64_t others = expect_as_found_anew("grid", *run.level);
    ck_assert_int_ge(others, 0);
    changed += others;
  }
  ck_assert_int_gt(changed, 50);
}
END_TEST

// Stars of another set of nodes cannot be restored.
START_TEST(of_other_nodes) {
  LevelRun run(add_square, constant(0.05));
  fill_level(*run.level);
  ck_assert(!pnpbs::restore_stars(*run.level));
  found_anew(*run.level);
  ck_assert(pnpbs::restore_stars(*run.level));
  pnpbs::delete_nodes(*run.level, {run.level->nodes.moves(0) ? 0 : 1});
  ck_assert(!pnpbs::restore_stars(*run.level));
}
END_TEST

TEST_SUITE(test_lawson_flips) {
  return run_kernel_suite("lawson_flips",
                          {after_sweeps, after_nodes_moved_a_little, after_few_nodes_moved_far,
                           to_an_exact_grid, of_other_nodes});
}
