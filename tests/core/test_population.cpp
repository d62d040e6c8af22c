// SPDX-License-Identifier: BSD-3-Clause
// Population control on lattices with a defect, and against a search over all nodes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "bubbles.hpp"
#include "population/population.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::PopulationChange;
using pnpbs::PopulationRule;

namespace {

template <int Dim>
using Set = std::vector<Bubble<Dim>>;

// A change in terms of ids, without an order.
template <int Dim>
struct Change {
  std::set<std::int64_t> deleted;
  std::map<std::int64_t, Point<Dim>> born;  // by parent
  bool operator==(const Change&) const = default;
};

struct Freedom {
  std::set<std::int64_t> must_go;
  bool (*fits)(double x, double y) = [](double, double) { return true; };
};

template <int Dim>
Change<Dim> choose(const Set<Dim>& set, const PopulationRule<Dim>& rule,
                   const Freedom& freedom = {}, double radius = 1.5) {
  Bubbles<Dim> b;
  b.box.low.fill(-1);
  b.box.high.fill(2);
  b.grow_tree([&](const Point<Dim>&) { return set[0].d; });
  b.set(set);
  b.list(radius);
  const PopulationChange<Dim> change = pnpbs::choose_population_change<Dim>(
      b.nodes, b.lists, pnpbs::overlap_ratios<Dim>(b.nodes, b.lists), rule,
      pnpbs::PopulationThresholds(rule),
      [&](std::int64_t i) { return freedom.must_go.count(b.nodes.id(i)) > 0; },
      [&](const Point<Dim>& x, double) { return freedom.fits(x[0], x[1]); });
  Change<Dim> by_id;
  for (std::int32_t i : change.deleted) quick_assert(by_id.deleted.insert(b.nodes.id(i)).second);
  quick_assert(std::is_sorted(change.deleted.begin(), change.deleted.end()));
  for (const pnpbs::Birth<Dim>& birth : change.born) {
    quick_assert(by_id.born.emplace(birth.parent, birth.position).second);
    for (const Bubble<Dim>& bubble : set)
      quick_assert(bubble.id != birth.parent || bubble.d == birth.d);
  }
  return by_id;
}

// ------------------------------------------------------------------ the rules, once more -------

template <int Dim>
struct Candidate {
  double defect = 0;
  bool removed = false;
  Point<Dim> place{};
};

template <int Dim>
bool adjacent(const Bubble<Dim>& a, const Bubble<Dim>& b, double radius) {
  return pnpbs::distance<Dim>(a.x, b.x) < radius * 0.5 * (a.d + b.d);
}

// Whether i and j are that many steps over neighbours apart, or fewer.
template <int Dim>
std::vector<std::size_t> within_hops(const Set<Dim>& set, std::size_t i, int hops, double radius) {
  std::set<std::size_t> seen{i};
  for (int hop = 0; hop < hops; ++hop) {
    std::set<std::size_t> more;
    for (std::size_t a : seen)
      for (std::size_t b = 0; b < set.size(); ++b)
        if (adjacent<Dim>(set[a], set[b], radius)) more.insert(b);
    seen.insert(more.begin(), more.end());
  }
  return {seen.begin(), seen.end()};
}

// The middle of the largest empty circle through node i and two of its neighbours, by all pairs:
// where the perpendicular bisectors meet. False if there is none, or the largest is wider than d.
bool hole_by_search(const Set<2>& set, std::size_t i, double radius, Point<2>& middle) {
  const Point<2>& x = set[i].x;
  std::vector<Point<2>> around;
  for (std::size_t j = 0; j < set.size(); ++j)
    if (j != i && adjacent<2>(set[i], set[j], radius)) around.push_back(set[j].x);
  double largest = 0;
  for (const Point<2>& a : around)
    for (const Point<2>& b : around) {
      const double ux = a[0] - x[0], uy = a[1] - x[1], wx = b[0] - x[0], wy = b[1] - x[1];
      const double det = ux * wy - uy * wx;
      if (det == 0) continue;
      const double u = 0.5 * (ux * ux + uy * uy), w = 0.5 * (wx * wx + wy * wy);
      const Point<2> y{x[0] + (u * wy - w * uy) / det, x[1] + (ux * w - wx * u) / det};
      const double r = pnpbs::distance<2>(x, y);
      const bool empty = std::all_of(around.begin(), around.end(), [&](const Point<2>& other) {
        return pnpbs::distance<2>(other, y) > r * (1 - 1e-8);
      });
      if (!empty || r <= largest) continue;
      largest = r;
      middle = y;
    }
  return largest > 0 && largest <= set[i].d;
}

template <int Dim>
Candidate<Dim> candidate(const Set<Dim>& set, std::size_t i, const PopulationRule<Dim>& rule,
                         const Freedom& freedom, double radius) {
  Candidate<Dim> result;
  const Bubble<Dim>& own = set[i];
  if (!own.moves) return result;
  double ratio = 0;
  Point<Dim> crowd{};
  for (std::size_t j = 0; j < set.size(); ++j) {
    if (j == i || !adjacent<Dim>(own, set[j], radius)) continue;
    const double gap = pnpbs::distance<Dim>(own.x, set[j].x);
    ratio += std::max(0.0, own.d + set[j].d / 2 - gap) / (own.d / 2);
    for (int k = 0; k < Dim; ++k) crowd[k] += (set[j].x[k] - own.x[k]) / (gap * gap);
  }
  if (freedom.must_go.count(own.id)) {
    result.defect = 1e300;
    result.removed = true;
  } else if (ratio > rule.delete_above) {
    result.defect = ratio - rule.ideal;
    result.removed = true;
  } else if (ratio < rule.insert_below) {
    const double length = pnpbs::distance<Dim>(crowd, {});
    for (int k = 0; k < Dim; ++k)
      result.place[k] = own.x[k] - own.d * (length > 0 ? crowd[k] / length : (k == 0 ? -1.0 : 0.0));
    if constexpr (Dim == 2) {
      Point<2> hole;
      if (hole_by_search(set, i, radius, hole)) result.place = hole;
    }
    if (!freedom.fits(result.place[0], result.place[1])) return result;
    double there = 0;  // the new bubble's ratio
    for (std::size_t j : within_hops<Dim>(set, i, 2, radius)) {
      const double gap = pnpbs::distance<Dim>(set[j].x, result.place);
      if (j != i && gap < rule.least_gap * 0.5 * (own.d + set[j].d)) return result;
      there += std::max(0.0, own.d + set[j].d / 2 - gap) / (own.d / 2);
    }
    if (there > rule.delete_above) return result;
    result.defect = rule.ideal - ratio;
  }
  return result;
}

// Two candidates this close may both act on the same place.
constexpr int kHops = 3;

template <int Dim>
void expect_as_by_search(const Set<Dim>& set, const PopulationRule<Dim>& rule,
                         const Freedom& freedom, double radius, std::size_t least_actors) {
  std::vector<Candidate<Dim>> candidates;
  for (std::size_t i = 0; i < set.size(); ++i)
    candidates.push_back(candidate<Dim>(set, i, rule, freedom, radius));
  Change<Dim> expected;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (candidates[i].defect == 0) continue;
    bool wins = true;
    for (std::size_t j : within_hops<Dim>(set, i, kHops, radius))
      wins = wins && (candidates[j].defect < candidates[i].defect ||
                      (candidates[j].defect == candidates[i].defect && set[j].id <= set[i].id));
    if (!wins) continue;
    if (candidates[i].removed)
      expected.deleted.insert(set[i].id);
    else
      expected.born[set[i].id] = candidates[i].place;
  }
  const Change<Dim> change = choose<Dim>(set, rule, freedom, radius);
  quick_assert(change.deleted == expected.deleted);
  ck_assert_uint_eq(change.born.size(), expected.born.size());
  for (const auto& [parent, place] : expected.born) {
    quick_assert(change.born.count(parent) == 1);
    ck_assert_double_lt(pnpbs::distance<Dim>(change.born.at(parent), place), 1e-11);
  }
  ck_assert_uint_ge(expected.deleted.size() + expected.born.size(), least_actors);

  // From another order in memory: the same, bit for bit.
  Set<Dim> mixed = set;
  Random(61).shuffle(mixed);
  quick_assert(choose<Dim>(mixed, rule, freedom, radius) == change);
}

// ------------------------------------------------------------------ lattices -------------------

constexpr double kSpacing = 0.05;

// A hexagonal lattice whose bubbles are 1 / stretch of its spacing; the outer ones do not move.
Set<2> lattice(double stretch) {
  return hexagonal_lattice(unit_box<2>(), kSpacing, kSpacing / stretch, 2.5 * kSpacing);
}

std::size_t nearest_to(const Set<2>& set, const Point<2>& x) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < set.size(); ++i)
    if (pnpbs::distance<2>(set[i].x, x) < pnpbs::distance<2>(set[nearest].x, x)) nearest = i;
  return nearest;
}

}  // namespace

START_TEST(perfect_lattices_stay) {
  for (const double stretch : {0.95, 1.0, 1.04}) {
    const Change<2> change = choose<2>(lattice(stretch), {});
    quick_assert(change.deleted.empty() && change.born.empty());
  }
}
END_TEST

// Whichever of the six around the hole are the sparsest, one new bubble comes into it, no second.
START_TEST(a_hole_is_filled_once) {
  Random random(62);
  for (const double radius : {1.5, 1.7}) {
    for (int trial = 0; trial < 40; ++trial) {
      Set<2> set = lattice(1.04);
      const std::size_t middle = nearest_to(set, {0.5, 0.5});
      const Point<2> hole = set[middle].x;
      for (Bubble<2>& b : set)
        for (double& x : b.x) x += random.between(-0.01, 0.01) * kSpacing;
      set.erase(set.begin() + static_cast<std::ptrdiff_t>(middle));
      const Change<2> change = choose<2>(set, {}, {}, radius);
      quick_assert(change.deleted.empty());
      ck_assert_uint_eq(change.born.size(), 1);
      ck_assert_double_lt(pnpbs::distance<2>(change.born.begin()->second, hole), 0.1 * kSpacing);
    }
  }
}
END_TEST

START_TEST(one_too_many_is_deleted) {
  Set<2> set = lattice(0.95);
  const Bubble<2> doubled = set[nearest_to(set, {0.5, 0.5})];
  set.push_back(doubled);
  set.back().x[0] += 0.05 * kSpacing;
  set.back().id = 1'000'000;
  const Change<2> change = choose<2>(set, {});
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
  Change<2> change = choose<2>(set, {}, freedom);
  quick_assert(change.deleted.empty() && change.born.empty());
  set.resize(1);
  set[0].x = {0.5, 0.5};
  change = choose<2>(set, {});
  quick_assert(change.deleted.empty() && change.born.empty());
  set[0].moves = true;
  change = choose<2>(set, {});
  ck_assert_uint_eq(change.born.size(), 1);
  ck_assert_double_eq_tol(pnpbs::distance<2>(change.born.begin()->second, set[0].x), set[0].d,
                          1e-15);
}
END_TEST

START_TEST(nodes_without_room_go_first) {
  Set<2> set = lattice(1.04);
  const std::size_t hole = nearest_to(set, {0.5, 0.5});
  const Point<2> x = set[hole].x;
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(hole));
  // Beside the hole: its going takes precedence over filling the hole, within three hops.
  const std::int64_t beside = set[nearest_to(set, {x[0] + kSpacing, x[1]})].id;
  Freedom freedom;
  freedom.must_go = {beside};
  const Change<2> change = choose<2>(set, {}, freedom);
  quick_assert(change.deleted == freedom.must_go);
  for (const auto& [parent, place] : change.born) {
    ck_assert_double_gt(pnpbs::distance<2>(set[nearest_to(set, x)].x, x), 0);
    quick_assert(parent != beside);
  }
  // Two side by side: one now, the other the next time.
  freedom.must_go.insert(set[nearest_to(set, {x[0] + 2 * kSpacing, x[1]})].id);
  const Change<2> first = choose<2>(set, {}, freedom);
  ck_assert_uint_eq(first.deleted.size(), 1);
  quick_assert(*first.deleted.begin() == *freedom.must_go.rbegin());
}
END_TEST

START_TEST(nothing_is_born_where_it_does_not_fit) {
  Set<2> set = lattice(1.04);
  const std::size_t hole = nearest_to(set, {0.5, 0.5});
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(hole));
  Freedom freedom;
  freedom.fits = [](double, double) { return false; };
  quick_assert(choose<2>(set, {}, freedom).born.empty());
}
END_TEST

// The node on the right is no neighbour of the one in the middle, only a neighbour's, but it is in
// the way of what would be born beside it.
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
  quick_assert(choose<2>(set, {}).born.empty());
  set.pop_back();
  const Change<2> change = choose<2>(set, {});
  ck_assert_uint_eq(change.born.size(), 1);
  ck_assert_double_lt(pnpbs::distance<2>(change.born.begin()->second, {d, 0}), 1e-15);
}
END_TEST

// Beyond the free place, as far from it as that is allowed, lie nodes that are dense for d, as at a
// small hole: what were born there would be one too many and go at once.
START_TEST(nothing_is_born_that_would_have_to_go) {
  const double d = 0.1, degree = std::acos(-1.0) / 180;
  Set<2> set{
      {{0, 0}, d, 0}, {{-0.75 * d, 0.45 * d}, d, 1, false}, {{-0.75 * d, -0.45 * d}, d, 2, false}};
  for (int k = 0; k < 8; ++k) {
    const double angle = (-75 + k * 150 / 7.0) * degree;
    set.push_back({{d + 0.7 * d * std::cos(angle), 0.7 * d * std::sin(angle)}, d, 3 + k, false});
  }
  PopulationRule<2> rule;
  rule.least_gap = 0.65;
  quick_assert(choose<2>(set, rule).born.empty());
  set.erase(set.begin() + 4, set.begin() + 10);
  ck_assert_uint_eq(choose<2>(set, rule).born.size(), 1);
}
END_TEST

// Two octaves of d, one too loose by four per cent in its distances, the other as much too dense:
// in each, so many are below or above its threshold as are missing or too many.
START_TEST(thresholds_follow_the_mean_distance) {
  Random random(64);
  PopulationRule<2> rule;
  rule.mean_distance = 1;
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
  // Near enough to the aim, or without one, nobody acts but for its own ratio.
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

START_TEST(contests_are_won_as_by_search) {
  Random random(63);
  const SpacingFunction<2> plane = [](const Point<2>& x) { return 0.05 + 0.06 * x[0]; };
  const SpacingFunction<3> volume = [](const Point<3>&) { return 0.16; };
  PopulationRule<3> in_volume;
  in_volume.insert_below = 11;
  for (const double radius : {1.5, 1.7}) {
    Set<2> set = random_bubbles<2>(random, 180, plane);
    for (std::size_t i = 0; i < set.size(); i += 11) set[i].moves = false;
    Freedom freedom;
    freedom.fits = [](double x, double y) { return x > 0 && x < 1 && y > 0 && y < 1; };
    expect_as_by_search<2>(set, {}, freedom, radius, 4);
    for (std::size_t i = 0; i < set.size(); i += 17) freedom.must_go.insert(set[i].id);
    expect_as_by_search<2>(set, {}, freedom, radius, 4);
    expect_as_by_search<3>(random_bubbles<3>(random, 200, volume), in_volume, freedom, radius, 2);
  }
}
END_TEST

// Many equal candidates: nobody within three hops of a winner wins as well.
START_TEST(winners_are_far_apart) {
  Set<2> set = lattice(1.2);  // every bubble is too lonely
  PopulationRule<2> rule;
  rule.least_gap = 0;
  const Change<2> change = choose<2>(set, rule);
  ck_assert_uint_gt(change.born.size(), 5);
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!change.born.count(set[i].id)) continue;
    for (std::size_t j : within_hops<2>(set, i, 3, 1.5))
      quick_assert(j == i || !change.born.count(set[j].id));
  }
}
END_TEST

int main() {
  return run_kernel_suite(
      "population",
      {perfect_lattices_stay, a_hole_is_filled_once, one_too_many_is_deleted,
       boundary_nodes_neither_go_nor_give_birth, nodes_without_room_go_first,
       nothing_is_born_where_it_does_not_fit, nothing_is_born_on_neighbours_of_neighbours,
       nothing_is_born_that_would_have_to_go, contests_are_won_as_by_search, winners_are_far_apart,
       thresholds_follow_the_mean_distance});
}
