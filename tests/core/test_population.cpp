// SPDX-License-Identifier: BSD-3-Clause
// Population control on lattices with a defect.
#include <algorithm>
#include <cmath>
#include <vector>

#include "population_change.hpp"
#include "run_kernel_suite.hpp"

namespace {

// ------------------------------------------------------------------ lattices -------------------

constexpr double kSpacing = 0.05;

// Returns a hexagonal lattice whose bubbles have a size of its spacing over `stretch`. The outer
// ones do not move.
Set<2> lattice(double stretch) {
  return hexagonal_lattice(unit_box<2>(), kSpacing, kSpacing / stretch, 2.5 * kSpacing);
}

}  // namespace

START_TEST(perfect_lattices_stay) {
  for (const double stretch : {0.95, 1.0, 1.04}) {
    const Change<2> change = choose<2>(lattice(stretch), by_thresholds<2>());
    quick_assert(change.deleted.empty() && change.born.empty());
  }
}
END_TEST

// Exactly one bubble is inserted in a hole, for any overlap ratios of the six bubbles around it.
START_TEST(a_hole_is_filled_once) {
  Random random(62);
  for (const double radius : {1.5, 1.7}) {
    for (int trial = 0; trial < 40; ++trial) {
      Set<2> set = lattice(1.04);
      const std::size_t middle = nearest_to<2>(set, {0.5, 0.5});
      const Point<2> hole = set[middle].x;
      for (Bubble<2>& b : set)
        for (double& x : b.x) x += random.between(-0.01, 0.01) * kSpacing;
      set.erase(set.begin() + static_cast<std::ptrdiff_t>(middle));
      const Change<2> change = choose<2>(set, by_thresholds<2>(), {}, radius);
      quick_assert(change.deleted.empty());
      ck_assert_uint_eq(change.born.size(), 1);
      ck_assert_double_lt(pnpbs::distance<2>(change.born.begin()->second, hole), 0.1 * kSpacing);
    }
  }
}
END_TEST

START_TEST(one_too_many_is_deleted) {
  Set<2> set = lattice(0.95);
  const Bubble<2> doubled = set[nearest_to<2>(set, {0.5, 0.5})];
  set.push_back(doubled);
  set.back().x[0] += 0.05 * kSpacing;
  set.back().id = 1'000'000;
  const Change<2> change = choose<2>(set, by_thresholds<2>());
  quick_assert(change.born.empty());
  ck_assert_uint_eq(change.deleted.size(), 1);
  quick_assert(change.deleted.count(doubled.id) + change.deleted.count(1'000'000) == 1);
}
END_TEST

START_TEST(boundary_nodes_neither_go_nor_give_birth) {
  Set<2> set = lattice(0.95);
  for (Bubble<2>& b : set) b.moves = false;
  Freedom freedom;
  for (const Bubble<2>& b : set) freedom.must_go.insert(b.id);
  Change<2> change = choose<2>(set, by_thresholds<2>(), freedom);
  quick_assert(change.deleted.empty() && change.born.empty());
  set.resize(1);
  set[0].x = {0.5, 0.5};
  change = choose<2>(set, by_thresholds<2>());
  quick_assert(change.deleted.empty() && change.born.empty());
  set[0].moves = true;
  change = choose<2>(set, by_thresholds<2>());
  ck_assert_uint_eq(change.born.size(), 1);
  ck_assert_double_eq_tol(pnpbs::distance<2>(change.born.begin()->second, set[0].x), set[0].d,
                          1e-15);
}
END_TEST

START_TEST(nodes_without_room_go_first) {
  Set<2> set = lattice(1.04);
  const std::size_t hole = nearest_to<2>(set, {0.5, 0.5});
  const Point<2> x = set[hole].x;
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(hole));
  // A bubble beside the hole must be deleted. This takes precedence over filling the hole within
  // three hops.
  const std::int64_t beside = set[nearest_to<2>(set, {x[0] + kSpacing, x[1]})].id;
  Freedom freedom;
  freedom.must_go = {beside};
  const Change<2> change = choose<2>(set, by_thresholds<2>(), freedom);
  quick_assert(change.deleted == freedom.must_go);
  for (const auto& [parent, place] : change.born) {
    ck_assert_double_gt(pnpbs::distance<2>(set[nearest_to<2>(set, x)].x, x), 0);
    quick_assert(parent != beside);
  }
  // One of two adjacent bubbles that must be deleted is deleted now, the other at the next event.
  freedom.must_go.insert(set[nearest_to<2>(set, {x[0] + 2 * kSpacing, x[1]})].id);
  const Change<2> first = choose<2>(set, by_thresholds<2>(), freedom);
  ck_assert_uint_eq(first.deleted.size(), 1);
  quick_assert(*first.deleted.begin() == *freedom.must_go.rbegin());
}
END_TEST

START_TEST(nothing_is_born_where_it_does_not_fit) {
  Set<2> set = lattice(1.04);
  const std::size_t hole = nearest_to<2>(set, {0.5, 0.5});
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(hole));
  Freedom freedom;
  freedom.fits = [](double, double) { return false; };
  quick_assert(choose<2>(set, by_thresholds<2>(), freedom).born.empty());
}
END_TEST

// The node on the right is not a neighbour of the central one, only of one of its neighbours. It
// still lies too near to the insertion point.
START_TEST(nothing_is_born_on_neighbours_of_neighbours) {
  const double d = 0.1;
  const auto fixed = [d](double x, double y, std::int64_t id) {
    return Bubble<2>{{x * d, y * d}, d, id, false};
  };
  Set<2> set{{{0, 0}, d, 0},
             fixed(0.78, 1.2, 1),
             fixed(-0.78, -1.2, 2),
             fixed(-1.2, 0, 3),
             fixed(1.58, 0, 4)};
  quick_assert(choose<2>(set, by_thresholds<2>()).born.empty());
  set.pop_back();
  const Change<2> change = choose<2>(set, by_thresholds<2>());
  ck_assert_uint_eq(change.born.size(), 1);
  ck_assert_double_lt(pnpbs::distance<2>(change.born.begin()->second, {d, 0}), 1e-15);
}
END_TEST

// Nodes that are dense for d lie beyond the free point, at the smallest permitted distance, as at a
// small hole. A node inserted there is surplus and is deleted at once.
START_TEST(nothing_is_born_that_would_have_to_go) {
  const double d = 0.1, degree = std::acos(-1.0) / 180;
  Set<2> set{
      {{0, 0}, d, 0}, {{-0.75 * d, 0.45 * d}, d, 1, false}, {{-0.75 * d, -0.45 * d}, d, 2, false}};
  for (int k = 0; k < 8; ++k) {
    const double angle = (-75 + k * 150 / 7.0) * degree;
    set.push_back({{d + 0.7 * d * std::cos(angle), 0.7 * d * std::sin(angle)}, d, 3 + k, false});
  }
  PopulationRule rule = by_thresholds<2>();
  rule.min_gap = 0.65;
  quick_assert(choose<2>(set, rule).born.empty());
  set.erase(set.begin() + 4, set.begin() + 10);
  ck_assert_uint_eq(choose<2>(set, rule).born.size(), 1);
}
END_TEST

// Two octaves of d: distances in one are four per cent too large, and in the other four per cent
// too small. In each, the number of nodes beyond the threshold equals the number of missing or
// surplus nodes.
START_TEST(thresholds_follow_the_mean_distance) {
  Random random(64);
  PopulationRule rule = default_rule<2>();
  const double stretch[] = {1.04, 0.96};
  Set<2> set;
  for (int half = 0; half < 2; ++half) {
    const double d = half == 0 ? 0.02 : 0.04;
    Set<2> part = hexagonal_lattice(unit_box<2>(), d * stretch[half], d, 2.5 * d);
    for (Bubble<2>& b : part) {
      for (double& x : b.x) x += random.between(-0.02, 0.02) * d;
      b.x[0] += 1.5 * half;  // side by side
      b.id = static_cast<std::int64_t>(set.size());
      set.push_back(b);
    }
  }
  Bubbles<2> b;
  b.box = {{-1, -1}, {4, 3}};
  b.grow_tree([](const Point<2>&) { return 0.02; });
  b.set(set);
  b.list(1.6);
  const pnpbs::View<double> ratios = pnpbs::overlap_ratios<2>(b.nodes, b.lists);
  const auto thresholds = pnpbs::choose_thresholds<2>(*pnpbs::serial_communicator(), b.nodes,
                                                      b.lists, ratios, rule, 0.001);
  for (int half = 0; half < 2; ++half) {
    const double d = half == 0 ? 0.02 : 0.04;
    const auto pair = thresholds.at(d);
    double bubbles = 0, act = 0;
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      if (!b.nodes.moves(i) || b.nodes.d(i) != d) continue;
      ++bubbles;
      act += half == 0 ? ratios(i) < pair.insert_below : ratios(i) > pair.delete_above;
    }
    const double wanted = bubbles * std::fabs(stretch[half] * stretch[half] - 1);
    ck_assert_double_gt(wanted, 10);
    ck_assert_double_le(act, wanted);
    ck_assert_double_ge(act, 0.6 * wanted);  // thresholds are multiples of 1/32
    if (half == 0)
      ck_assert_double_eq(pair.delete_above, rule.delete_above);
    else
      ck_assert_double_eq(pair.insert_below, 0);
  }
  // Close to the target, or without one, the thresholds stay at those of the rule.
  for (const auto& [aim, tolerance] : {std::pair{1.0, 0.05}, std::pair{0.0, 0.001}}) {
    rule.mean_distance = aim;
    const auto left = pnpbs::choose_thresholds<2>(*pnpbs::serial_communicator(), b.nodes, b.lists,
                                                  ratios, rule, tolerance);
    for (const double d : {0.02, 0.04}) {
      ck_assert_double_eq(left.at(d).insert_below, 0);
      ck_assert_double_eq(left.at(d).delete_above, rule.delete_above);
    }
  }
}
END_TEST

// No two of many equal candidates within three hops win.
START_TEST(winners_are_far_apart) {
  Set<2> set = lattice(1.2);  // the overlap ratio of every bubble is too small
  PopulationRule rule = by_thresholds<2>();
  rule.min_gap = 0;
  const Change<2> change = choose<2>(set, rule);
  ck_assert_uint_gt(change.born.size(), 5);
  expect_actors_far_apart<2>(set, change, 1.5);
}
END_TEST

TEST_SUITE(test_population) {
  return run_kernel_suite(
      "population",
      {perfect_lattices_stay, a_hole_is_filled_once, one_too_many_is_deleted,
       boundary_nodes_neither_go_nor_give_birth, nodes_without_room_go_first,
       nothing_is_born_where_it_does_not_fit, nothing_is_born_on_neighbours_of_neighbours,
       nothing_is_born_that_would_have_to_go, winners_are_far_apart,
       thresholds_follow_the_mean_distance});
}
