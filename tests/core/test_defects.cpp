// SPDX-License-Identifier: BSD-3-Clause
// Repair of defects that shifting nodes cannot remove: missing and surplus nodes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "distorted_nodes.hpp"
#include "quality/plane/defects.hpp"
#include "run_kernel_suite.hpp"

using IncomingNode = pnpbs::IncomingNode<2>;
using IncomingNodes = pnpbs::IncomingNodes<2>;
using Level = pnpbs::Level<2>;
using pnpbs::PopulationCounts;
using P = pnpbs::Point<2>;

namespace {

const Build kSquare = [](pnpbs::PlaneDomain& p) {
  shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1));
};
constexpr double kD = 0.03;

IncomingNodes lattice() {
  LevelRun fill(kSquare, constant(kD));
  fill_level(*fill.level);
  return inner_nodes_of(*fill.level);
}

std::size_t nearest(const IncomingNodes& nodes, const P& x) {
  const auto nearer = [&](const IncomingNode& a, const IncomingNode& b) {
    return pnpbs::distance<2>(a.position, x) < pnpbs::distance<2>(b.position, x);
  };
  return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(), nearer) -
                                  nodes.begin());
}

// Removes the lattice node nearest to a point and returns its position.
P take_away(IncomingNodes& nodes, const P& near) {
  const std::size_t k = nearest(nodes, near);
  const P place = nodes[k].position;
  nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(k));
  return place;
}

// Replaces the lattice node nearest to a point by two nodes at this distance.
P split(IncomingNodes& nodes, const P& near, double apart) {
  IncomingNode& node = nodes[nearest(nodes, near)];
  const P place = node.position;
  node.position[0] -= 0.5 * apart;
  nodes.push_back({{place[0] + 0.5 * apart, place[1]}, 1 << 20});
  return place;
}

// The lattice has bad triangles along the walls, which are ignored here.
LevelRun run_with(const IncomingNodes& nodes) {
  LevelRun run(kSquare, constant(kD), {}, [](pnpbs::Settings& settings) {
    settings.defects.bad_below = 0;
    settings.repair.rounds = 0;
  });
  pnpbs::take(*run.level, nodes, 1 << 21);
  return run;
}

double min_quality(LevelRun& run) {
  run.renew_stars();
  const Places places = places_by_id(*run.level);
  double min = 1;
  for (const Triangle& t : triangles_by_id(*run.level)) min = std::min(min, quality_of(t, places));
  return min;
}

// Returns the distance from a point to the nearest node.
double gap_at(const Level& level, const P& x) {
  double gap = 1;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    gap = std::min(gap, pnpbs::distance<2>(level.nodes.position(i), x));
  return gap;
}

void check_counts(const PopulationCounts& counts, std::int64_t inserted, std::int64_t deleted) {
  ck_assert_int_eq(counts.inserted, inserted);
  ck_assert_int_eq(counts.deleted, deleted);
}

}  // namespace

START_TEST(lattice_stays) {
  LevelRun run = run_with(lattice());
  const std::int64_t nodes = run.level->nodes.count;
  check_counts(pnpbs::repair_defects(*run.level), 0, 0);
  ck_assert_int_eq(run.level->nodes.count, nodes);
}
END_TEST

// The triangles that fill a hole in the lattice have a node with eight neighbours.
START_TEST(missing_node_comes) {
  IncomingNodes nodes = lattice();
  const P hole = take_away(nodes, {0.4, 0.6});
  LevelRun run = run_with(nodes);
  const std::int64_t before = run.level->nodes.count;
  check_counts(pnpbs::repair_defects(*run.level), 1, 0);
  ck_assert_int_eq(run.level->nodes.count, before + 1);
  ck_assert_double_lt(gap_at(*run.level, hole), 0.3 * kD);
  pnpbs::sweep_and_repair(*run.level, 20);
  LevelRun whole = run_with(lattice());
  pnpbs::sweep_and_repair(*whole.level, 20);
  ck_assert_double_gt(min_quality(run), min_quality(whole) - 0.01);
  check_counts(pnpbs::repair_defects(*run.level), 0, 0);
}
END_TEST

// The two nodes that replace one have five neighbours each. So do the two of a relaxed pair.
START_TEST(surplus_node_goes) {
  for (const double apart : {0.4 * kD, 0.7 * kD})
    for (const std::int64_t sweeps : {0, 10}) {
      IncomingNodes nodes = lattice();
      const P place = split(nodes, {0.6, 0.4}, apart);
      LevelRun run = run_with(nodes);
      pnpbs::sweep_and_repair(*run.level, sweeps);
      check_counts(pnpbs::repair_defects(*run.level), 0, 1);
      pnpbs::sweep_and_repair(*run.level, 20);
      ck_assert_double_lt(gap_at(*run.level, place), 0.1 * kD);
      check_counts(pnpbs::repair_defects(*run.level), 0, 0);
    }
}
END_TEST

// Two defects within five rings are repaired in successive rounds, distant defects in the same
// round.
START_TEST(near_defects_take_turns) {
  IncomingNodes nodes = lattice();
  take_away(nodes, {0.3, 0.5});
  take_away(nodes, {0.3 + 4 * kD, 0.5});
  take_away(nodes, {0.7, 0.5});
  LevelRun run = run_with(nodes);
  check_counts(pnpbs::repair_defects(*run.level), 2, 0);
  check_counts(pnpbs::repair_defects(*run.level), 1, 0);
  check_counts(pnpbs::repair_defects(*run.level), 0, 0);
}
END_TEST

// Repairs leave fewer bad triangles than sweeps alone for each shape, and nodes keep their
// clearance.
START_TEST(bad_triangles_become_fewer) {
  std::uint64_t seed = 180;
  for (const Shape& shape : shapes_to_finish()) {
    const double bad = pnpbs::DefectRule{}.bad_below;
    const auto bad_after = [&](int rounds) {
      LevelRun run = distorted(shape.build, shape.d, seed,
                               [](pnpbs::Settings& settings) { settings.repair.rounds = 0; });
      pnpbs::sweep_and_repair(*run.level, 20);
      std::int64_t changes = 0;
      for (int round = 0; round < rounds; ++round) {
        const PopulationCounts counts = pnpbs::repair_defects(*run.level);
        changes += counts.inserted + counts.deleted;
        pnpbs::sweep_and_repair(*run.level, 20);
      }
      if (rounds > 0) ck_assert_int_gt(changes, 5);
      for (std::int64_t i = 0; i < run.level->nodes.count; ++i) {
        const P x = run.level->nodes.position(i);
        if (!run.level->nodes.moves(i)) continue;
        quick_assert(run.level->map().inside(x));
        quick_assert(run.level->map().clearance(x, run.level->nodes.d(i)) >=
                     0.35 * run.level->nodes.d(i) * (1 - 1e-12));
      }
      run.renew_stars();
      star_triangles(*run.level);  // checks that they conform
      const Places places = places_by_id(*run.level);
      std::int64_t count = 0;
      for (const Triangle& t : triangles_by_id(*run.level)) count += quality_of(t, places) < bad;
      return count;
    };
    ++seed;
    ck_assert_int_lt(3 * bad_after(3), 2 * bad_after(0));
  }
}
END_TEST

TEST_SUITE(test_defects) {
  return run_kernel_suite("defects", {lattice_stays, missing_node_comes, surplus_node_goes,
                                      near_defects_take_turns, bad_triangles_become_fewer});
}
