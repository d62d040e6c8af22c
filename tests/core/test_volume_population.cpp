// SPDX-License-Identifier: BSD-3-Clause
// Population control in space, on body-centred cubic lattices with holes and surplus nodes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "population_change.hpp"
#include "run_kernel_suite.hpp"
#include "volume_box.hpp"

namespace {

constexpr volume_box::Crystal kCrystal{8};
constexpr double kSide = 8 * volume_box::kCell;

// Returns a lattice whose bubbles have 1 / stretch of the size that fits.
Set<3> lattice(double stretch = 1, const volume_box::Crystal& sites = kCrystal) {
  Set<3> set = volume_box::sites(sites);
  for (Bubble<3>& b : set) b.d = 1 / stretch;
  return set;
}

void jitter(Random& random, Set<3>& set, double max) {
  for (Bubble<3>& b : set)
    for (double& x : b.x) x += random.between(-max, max);
}

Point<3> middle_of(const Set<3>& set) {
  Point<3> middle{};
  for (const Bubble<3>& b : set)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += b.x[k] / static_cast<double>(set.size());
  return middle;
}

// Returns the mean distance of touching bubbles that move. Near the fixed ones the shares of the 8
// nearest and the 6 next neighbours differ, so the value is not exactly 1 even for a perfect
// lattice.
double mean_distance(const Set<3>& set) {
  double sum = 0, pairs = 0;
  for (const Bubble<3>& a : set)
    for (const Bubble<3>& b : set) {
      const double gap = pnpbs::distance<3>(a.x, b.x);
      if (!a.moves || !b.moves || gap == 0 || gap > 1.3) continue;
      sum += gap;
      ++pairs;
    }
  return sum / pairs;
}

// Removes the node nearest to the centre and those within this many d of it. Returns their
// positions.
std::vector<Point<3>> dig(Set<3>& set, double within) {
  const Point<3> middle = set[nearest_to<3>(set, middle_of(set))].x;
  std::vector<Point<3>> gone;
  std::erase_if(set, [&](const Bubble<3>& b) {
    if (pnpbs::distance<3>(b.x, middle) > within) return false;
    gone.push_back(b.x);
    return true;
  });
  return gone;
}

double min_distance(const std::vector<Point<3>>& places, const Point<3>& x) {
  double min = 1e300;
  for (const Point<3>& place : places) min = std::min(min, pnpbs::distance<3>(place, x));
  return min;
}

// Deletes and inserts nodes as chosen; new nodes get the next ids.
void carry_out(Set<3>& set, const Change<3>& change, std::int64_t& next_id) {
  std::erase_if(set, [&](const Bubble<3>& b) { return change.deleted.count(b.id) > 0; });
  for (const auto& [parent, place] : change.born) set.push_back({place, set[0].d, next_id++, true});
}

Set<3> shuffled(Set<3> set) {
  Random(95).shuffle(set);
  return set;
}

}  // namespace

START_TEST(perfect_lattices_stay) {
  for (const double stretch : {0.95, 1.0, 1.05}) {
    const Change<3> change = choose<3>(lattice(stretch), by_thresholds<3>());
    quick_assert(change.deleted.empty() && change.born.empty());
  }
}
END_TEST

// The eight nearest nodes around a vacancy compete for it. The threshold must be near the ideal
// ratio, as each keeps 13 of 14.
START_TEST(a_vacancy_is_filled_once) {
  Random random(96);
  PopulationRule rule = by_thresholds<3>();
  quick_assert(choose<3>(
                   [] {
                     Set<3> set = lattice();
                     dig(set, 0.1);
                     return set;
                   }(),
                   rule)
                   .born.empty());
  rule.insert_below = 13.2;
  for (int trial = 0; trial < 8; ++trial) {
    Set<3> set = lattice();
    jitter(random, set, 0.01);
    const std::vector<Point<3>> gone = dig(set, 0.1);
    ck_assert_uint_eq(gone.size(), 1);
    const Change<3> change = choose<3>(set, rule);
    quick_assert(change.deleted.empty());
    ck_assert_uint_eq(change.born.size(), 1);
    ck_assert_double_lt(min_distance(gone, change.born.begin()->second), 0.05);
    quick_assert(choose<3>(shuffled(set), rule) == change);
  }
}
END_TEST

// The 27 sites around the centre, of 2331, are empty. The other nodes move into the hole until no
// overlap ratio is below the threshold. Only a target mean distance fills the hole, event after
// event, up to its tolerance (0.3 % of the nodes that move).
START_TEST(a_hole_is_filled) {
  constexpr volume_box::Crystal kTen{10};
  const Set<3> perfect = lattice(1, kTen);
  Set<3> set = perfect;
  ck_assert_uint_eq(dig(set, 1.6).size(), 27);
  PopulationRule rule = by_thresholds<3>();
  quick_assert(choose<3>(set, rule).born.empty());
  rule.mean_distance = mean_distance(perfect);
  std::int64_t next_id = 1'000'000;
  int last_act = 0;
  volume_box::Relaxation relaxation(kTen);
  for (int event = 1; event <= 40; ++event) {
    const Change<3> change = choose<3>(set, rule, {}, 1.6);
    quick_assert(choose<3>(shuffled(set), rule, {}, 1.6) == change);
    expect_actors_far_apart<3>(set, change, 1.6);
    if (change.born.size() + change.deleted.size() > 0) last_act = event;
    carry_out(set, change, next_id);
    relaxation.set(set);
    relaxation.steps(20);
    set = relaxation.bubbles().bubbles();
  }
  ck_assert_int_lt(last_act, 36);
  ck_assert_uint_le(set.size(), perfect.size());
  ck_assert_uint_ge(set.size(), perfect.size() - 4);
  const auto taken = std::count_if(perfect.begin(), perfect.end(), [&](const Bubble<3>& site) {
    // Nodes beside a vacancy are displaced.
    return pnpbs::distance<3>(set[nearest_to<3>(set, site.x)].x, site.x) < 0.4;
  });
  ck_assert_uint_eq(static_cast<std::size_t>(taken), set.size());
}
END_TEST

// An additional node is close to another one in a slightly dense lattice. One of the two is
// deleted.
START_TEST(a_surplus_node_is_deleted) {
  Set<3> set = lattice(0.94);
  const Bubble<3> doubled = set[nearest_to<3>(set, middle_of(set))];
  set.push_back(doubled);
  set.back().x[0] += 0.07;
  set.back().id = 1'000'000;
  const Change<3> change = choose<3>(set, by_thresholds<3>());
  quick_assert(change.born.empty());
  ck_assert_uint_eq(change.deleted.size(), 1);
  quick_assert(change.deleted.count(doubled.id) + change.deleted.count(1'000'000) == 1);
  quick_assert(choose<3>(shuffled(set), by_thresholds<3>()) == change);
}
END_TEST

// All overlap ratios are too small or too large: the nodes with the largest defects act, three hops
// apart.
START_TEST(actors_are_far_apart) {
  Random random(97);
  for (const double stretch : {1.25, 0.8}) {
    Set<3> set = lattice(stretch, {12});
    jitter(random, set, 0.1);
    PopulationRule rule = by_thresholds<3>();
    rule.min_gap = 0;
    const Change<3> change = choose<3>(set, rule);
    ck_assert_uint_ge(change.born.size() + change.deleted.size(), 2);
    expect_actors_far_apart<3>(set, change, 1.5);
    quick_assert(choose<3>(shuffled(set), rule) == change);
  }
}
END_TEST

// Distances are four per cent too large or too small. The number of nodes beyond the threshold
// equals the number of missing or surplus nodes, which follows from the cube of the factor.
START_TEST(thresholds_follow_the_mean_distance) {
  Random random(98);
  PopulationRule rule = default_rule<3>();
  for (const double stretch : {1.04, 0.96}) {
    Set<3> set = lattice(stretch);
    jitter(random, set, 0.02);
    Bubbles<3> b;
    b.box = pnpbs::box_around<3>(middle_of(set), 0.55 * kSide);
    b.grow_tree([](const Point<3>&) { return 1.0; });
    b.set(set);
    b.list(1.6);
    const pnpbs::View<double> ratios = pnpbs::overlap_ratios<3>(b.nodes, b.lists);
    const auto pair = pnpbs::choose_thresholds<3>(*pnpbs::serial_communicator(), b.nodes, b.lists,
                                                  ratios, rule, 0.001)
                          .at(b.nodes.d(0));
    double bubbles = 0, act = 0;
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      if (!b.nodes.moves(i)) continue;
      ++bubbles;
      act += stretch > 1 ? ratios(i) < pair.insert_below : ratios(i) > pair.delete_above;
    }
    const double wanted = bubbles * std::fabs(std::pow(stretch, 3) - 1);
    ck_assert_double_gt(wanted, 20);
    ck_assert_double_le(act, 1.02 * wanted);
    ck_assert_double_ge(act, 0.6 * wanted);  // thresholds are multiples of 1/32
    if (stretch > 1)
      ck_assert_double_eq(pair.delete_above, rule.delete_above);
    else
      ck_assert_double_eq(pair.insert_below, 0);
  }
}
END_TEST

TEST_SUITE(test_volume_population) {
  return run_kernel_suite(
      "volume_population",
      {perfect_lattices_stay, a_vacancy_is_filled_once, a_hole_is_filled, a_surplus_node_is_deleted,
       actors_are_far_apart, thresholds_follow_the_mean_distance});
}
