// SPDX-License-Identifier: BSD-3-Clause
// Start nodes of a finer level, counted by Euler's formula. On a domain without holes, n nodes with
// b on the boundary have 3 n - 3 - b edges, b of which are on the boundary, and 2 n - b - 2
// triangles.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/lattice.hpp"
#include "level_run.hpp"
#include "run_kernel_suite.hpp"

using IncomingNode = pnpbs::IncomingNode<2>;
using IncomingNodes = pnpbs::IncomingNodes<2>;
using pnpbs::PlaneDomain;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

void square(PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 1)); }

// A square in which the bubbles are at rest.
struct Rested {
  LevelRun run;
  std::int64_t n, b;

  explicit Rested(const Plane& d) : run(square, d) {
    fill_level(*run.level);
    run.steps(60);
    n = run.level->owned_count();
    b = run.level->geometry.boundary_nodes();
  }
};

IncomingNodes new_ones(const IncomingNodes& nodes) {
  IncomingNodes found;
  for (const IncomingNode& node : nodes)
    if (node.id < 0) found.push_back(node);
  return found;
}

// Returns whether x is the midpoint of two of the nodes, by a search over all pairs.
bool halves_a_pair(const IncomingNodes& nodes, const P& x, double longest) {
  for (const IncomingNode& a : nodes) {
    if (a.id < 0 || pnpbs::distance<2>(a.position, x) > longest) continue;
    const P other{2 * x[0] - a.position[0], 2 * x[1] - a.position[1]};
    for (const IncomingNode& c : nodes)
      if (c.id >= 0 && pnpbs::distance<2>(c.position, other) < 1e-12) return true;
  }
  return false;
}

START_TEST(half_the_spacing_halves_every_edge) {
  Rested level(constant(0.05));
  const IncomingNodes nodes = pnpbs::refined(*level.run.level, *spacing_of(constant(0.025)));
  const IncomingNodes born = new_ones(nodes);
  ck_assert_int_eq(born.size(), 3 * level.n - 3 - 2 * level.b);
  ck_assert_int_eq(nodes.size() - born.size(), level.n);
  for (const IncomingNode& node : born) {
    quick_assert(halves_a_pair(nodes, node.position, 0.05));
    quick_assert(node.inner && node.d == 0);  // none is to be thinned
  }
}
END_TEST

START_TEST(a_third_fills_triangles_too) {
  Rested level(constant(0.05));
  const IncomingNodes born =
      new_ones(pnpbs::refined(*level.run.level, *spacing_of(constant(0.05 / 3))));
  // The few edges that are shorter by a sixth are only halved.
  const double edges = static_cast<double>(3 * level.n - 3 - 2 * level.b),
               triangles = static_cast<double>(2 * level.n - level.b - 2);
  ck_assert_double_le(static_cast<double>(born.size()), 2 * edges + triangles);
  ck_assert_double_ge(static_cast<double>(born.size()), 0.98 * (2 * edges + triangles));
  std::set<P> places;
  for (const IncomingNode& node : born) places.insert(node.position);
  ck_assert_uint_eq(places.size(), born.size());
}
END_TEST

START_TEST(only_where_it_is_finer) {
  Rested level(constant(0.05));
  for (const double d : {0.2, 0.05, 0.04}) {
    const IncomingNodes nodes = pnpbs::refined(*level.run.level, *spacing_of(constant(d)));
    ck_assert_int_eq(nodes.size(), level.n);
    ck_assert_uint_eq(new_ones(nodes).size(), 0);
    // Nodes placed for a smaller d carry it, so that they can be thinned.
    for (const IncomingNode& node : nodes) quick_assert((node.d > 0) == (d > 0.1));
  }
  // An edge belongs to its end with the smaller id, so counts near the line are uncertain.
  const IncomingNodes born = new_ones(pnpbs::refined(
      *level.run.level, *spacing_of([](double x, double) { return x < 0.5 ? 0.025 : 0.05; })));
  ck_assert_double_ge(static_cast<double>(born.size()),
                      0.9 * static_cast<double>(3 * level.n - 3 - 2 * level.b) / 2);
  for (const IncomingNode& node : born) quick_assert(node.position[0] < 0.5 + 0.03);
}
END_TEST

// The growth of d within a leaf exceeds the threshold above which nodes are thinned.
START_TEST(growth_of_d_thins_none) {
  const auto grows = [](double scale) {
    return [scale](double x, double y) { return scale * (0.02 + 0.1 * std::hypot(x, y)); };
  };
  Rested coarse(grows(2));
  LevelRun fine(square, grows(1));
  const IncomingNodes nodes = pnpbs::refined(*coarse.run.level, *spacing_of(grows(1)));
  ck_assert_int_eq(pnpbs::take(*fine.level, nodes, coarse.run.level->next_id).thinned, 0);
}
END_TEST

// Nodes that stay keep their ids and positions. Nodes of the refined level have about six
// neighbours each.
START_TEST(a_refined_level_is_nearly_right) {
  Rested coarse(constant(0.05));
  LevelRun fine(square, constant(0.025));
  const IncomingNodes nodes = pnpbs::refined(*coarse.run.level, *spacing_of(constant(0.025)));
  const pnpbs::ImportedNodes taken = pnpbs::take(*fine.level, nodes, coarse.run.level->next_id);
  ck_assert_int_eq(taken.thinned, 0);
  // The boundary is discretised again, at half the spacing.
  ck_assert_int_eq(fine.level->geometry.boundary_nodes(), 2 * coarse.b);
  ck_assert_int_eq(fine.level->owned_count() + taken.left_out,
                   coarse.n - coarse.b + (3 * coarse.n - 3 - 2 * coarse.b) + 2 * coarse.b);
  const double wanted = pnpbs::Lattice<2>::kDensity / (0.025 * 0.025) + 0.5 * 160;
  ck_assert_double_le(std::fabs(static_cast<double>(fine.level->owned_count()) / wanted - 1), 0.03);
  fine.renew_stars();
  std::int64_t six = 0, inner = 0;
  for (std::int64_t i = 0; i < fine.level->nodes.count; ++i) {
    if (!fine.level->nodes.moves(i)) continue;
    ++inner;
    six += fine.level->stars.size(i) == 6;
  }
  ck_assert_double_ge(static_cast<double>(six), 0.93 * static_cast<double>(inner));
}
END_TEST

}  // namespace

TEST_SUITE(test_refining) {
  return run_kernel_suite("refining", {half_the_spacing_halves_every_edge,
                                       a_third_fills_triangles_too, only_where_it_is_finer,
                                       growth_of_d_thins_none, a_refined_level_is_nearly_right});
}
