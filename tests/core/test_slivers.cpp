// SPDX-License-Identifier: BSD-3-Clause
// The finish in space: sweeps to the mean of the neighbours, and the repair of slivers with a
// triangulation that follows every moved node.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "predicates/space.hpp"
#include "quality/volume/mean_sweep.hpp"
#include "quality/volume/sliver_repair.hpp"
#include "quality/volume/small_node_set.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "run_kernel_suite.hpp"
#include "sliver_rounds.hpp"
#include "volume_box.hpp"
#include "volume_tetrahedra.hpp"

using Corners = std::array<Point<3>, 4>;
using volume_tetrahedra::Ids;
using volume_tetrahedra::in_stars;
using volume_tetrahedra::Places;
using volume_tetrahedra::places_by_id;

namespace {

bool anywhere(std::int64_t, const Point<3>&) { return true; }

// A lattice box with random displacements, and its stars.
struct Shaken {
  Bubbles<3> b;
  pnpbs::KnownRegion<3> everywhere;
  pnpbs::VolumeStars stars;

  explicit Shaken(int cells, double by, double leaf = 3) {
    const volume_box::Crystal crystal{cells};
    b.box = crystal.box();
    b.grow_tree([](const Point<3>&) { return 1.0; }, leaf);
    std::vector<Bubble<3>> bubbles = volume_box::sites(crystal);
    volume_box::shake(bubbles, by);
    b.set(bubbles);
    make_stars();
  }
  Shaken(const Shaken&) = delete;

  void make_stars() {
    b.list(1.6);
    stars.build({b.nodes, b.tree, b.buckets, b.lists, everywhere});
  }

  // Returns the smallest angle of tetrahedra with a node that moves, by the current stars.
  double least_angle() const {
    double least = 180;
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      stars.for_simplices(i, [&](const std::array<std::int32_t, 3>& others) {
        if (!b.nodes.moves(i)) return;
        Corners x{b.nodes.position(i)};
        for (std::size_t k = 0; k < 3; ++k) x[k + 1] = b.nodes.position(others[k]);
        least = std::min(least, pnpbs::min_dihedral_angle(x));
      });
    return least;
  }
};

double volume(const Corners& x) {
  const Point<3> u = pnpbs::difference(x[1], x[0]), v = pnpbs::difference(x[2], x[0]);
  return pnpbs::dot(pnpbs::cross(u, v), pnpbs::difference(x[3], x[0])) / 6;
}

// Returns the corners in positive orientation.
Corners corners_of(const Ids& ids, const Places& places) {
  Corners x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = places.at(ids[k]);
  if (volume(x) < 0) std::swap(x[0], x[1]);
  return x;
}

// Checks against all nodes that each tetrahedron is in four stars, no node is inside a sphere, and
// tetrahedra neither overlap nor leave gaps.
void expect_delaunay(const std::multiset<Ids>& tetrahedra, const Places& places, double space) {
  double sum = 0;
  for (auto t = tetrahedra.begin(); t != tetrahedra.end(); t = tetrahedra.upper_bound(*t)) {
    ck_assert_uint_eq(tetrahedra.count(*t), 4);
    const Corners x = corners_of(*t, places);
    sum += volume(x);
    for (const auto& [id, p] : places) {
      if (std::find(t->begin(), t->end(), id) != t->end()) continue;
      quick_assert(pnpbs::in_sphere(x[0], x[1], x[2], x[3], p) <= 0);
    }
  }
  ck_assert_double_eq_tol(sum, space, 1e-9 * space);
}

double space_of(const std::multiset<Ids>& tetrahedra, const Places& places) {
  double sum = 0;
  for (const Ids& t : tetrahedra) sum += volume(corners_of(t, places)) / 4;
  return sum;
}

}  // namespace

// ------------------------------------------------------------------ angles ---------------------

START_TEST(known_angles) {
  const double h = std::sqrt(2.0) / 2;
  const Corners body_centred{Point<3>{-h, 0, 0}, Point<3>{h, 0, 0}, Point<3>{0, h, h},
                             Point<3>{0, -h, h}};
  // Two angles are 90 degrees, four are 60.
  const pnpbs::SmallAngles below_61(61), below_59(59);
  quick_assert(below_61.any(body_centred) && !below_59.any(body_centred));
  ck_assert_double_eq_tol(below_61.penalty(body_centred), 4, 1e-9);
  ck_assert_double_eq(below_59.penalty(body_centred), 0);
  // A flat tetrahedron has four angles of 0 and two of 180.
  const Corners flat{Point<3>{0, 0, 0}, Point<3>{1, 0, 0}, Point<3>{1, 1, 0}, Point<3>{0, 1, 0}};
  ck_assert_double_eq_tol(pnpbs::SmallAngles(35).penalty(flat), 4 * 35 * 35, 1e-6);
}
END_TEST

START_TEST(angles_of_any_tetrahedron) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    Corners x;
    for (Point<3>& p : x) p = random.point<3>(unit_box<3>());
    double expected = 0;
    for (const double angle : pnpbs::dihedral_angles(x))
      expected += std::pow(std::max(0.0, 35 - angle), 2);
    ck_assert_double_eq_tol(pnpbs::SmallAngles(35).penalty(x), expected, 1e-7 * (1 + expected));
    std::swap(x[1], x[2]);  // with negative orientation
    ck_assert_double_eq_tol(pnpbs::SmallAngles(35).penalty(x), expected, 1e-7 * (1 + expected));
  }
}
END_TEST

START_TEST(small_node_set_is_found) {
  Random random(4);
  pnpbs::SmallNodeSet few;
  std::vector<std::int32_t> all;
  quick_assert(!few.contains(0) && few.all().empty());
  while (all.size() < 70) {
    const auto node = static_cast<std::int32_t>(random.below(1000));
    few.add(node);
    all.push_back(node);
    quick_assert(std::ranges::equal(few.all(), all));
    for (std::int32_t i = 0; i < 1000; ++i)
      quick_assert(few.contains(i) == (std::ranges::count(all, i) > 0));
  }
}
END_TEST

// surely_none is never wrong, for any order of the corners, and decides most tetrahedra.
START_TEST(surely_no_small_angles) {
  Random random(2);
  const pnpbs::SmallAngles small(35);
  int none = 0, told = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Corners x;
    for (Point<3>& p : x) p = random.point<3>(unit_box<3>());
    if (trial % 4 == 0)  // almost flat
      for (Point<3>& p : x) p[2] *= std::pow(10.0, -random.between(0, 20));
    std::array<int, 4> order{0, 1, 2, 3};
    bool any = false, surely = false;
    do {
      Corners permuted;
      for (std::size_t k = 0; k < 4; ++k) permuted[k] = x[static_cast<std::size_t>(order[k])];
      any = any || small.any(permuted) || small.penalty(permuted) > 0;
      surely = surely || small.surely_none(permuted);
    } while (std::next_permutation(order.begin(), order.end()));
    quick_assert(!(any && surely));
    none += !any;
    told += surely;
  }
  ck_assert_int_gt(none, 100);
  ck_assert_int_ge(told, none - 2);
}
END_TEST

// ------------------------------------------------------------------ one node moves -------------

START_TEST(stars_follow_nodes) {
  Shaken s(6, 0.25);
  pnpbs::Nodes<3>& nodes = s.b.nodes;
  const double space = space_of(in_stars(s.b.nodes, s.stars), places_by_id(s.b.nodes));
  pnpbs::StarChanges changes(nodes, s.stars);
  Random random(2);
  std::int64_t gone = 0, made = 0, far = 0, refused = 0;
  for (int move = 0; move < 2000; ++move) {
    const auto i = static_cast<std::int32_t>(random.below(nodes.count));
    if (!nodes.moves(i)) continue;
    const double way = move % 10 == 0 ? 0.8 : 0.28;
    Point<3> x = nodes.position(i);
    for (double& along : x) along += random.between(-way, way);
    pnpbs::NodeMove attempt(nodes, changes, i);
    if (!attempt.go_to(x) || !attempt.complete()) {
      ++refused;
      continue;
    }
    far += move % 10 == 0;
    gone += std::ssize(attempt.change().gone);
    made += std::ssize(attempt.change().made);
    changes.accept({&attempt.change(), 1});
    nodes.set_position(i, x);
    if (move % 400 == 0)
      expect_delaunay(in_stars(s.b.nodes, changes), places_by_id(s.b.nodes), space);
  }
  expect_delaunay(in_stars(s.b.nodes, changes), places_by_id(s.b.nodes), space);
  ck_assert_int_gt(gone, 2000);
  ck_assert_int_gt(made, 2000);
  ck_assert_int_gt(far, 3);
  ck_assert_int_lt(refused, far);
  // Neighbours are updated as well.
  const std::multiset<Ids> followed = in_stars(s.b.nodes, changes);
  std::map<std::int64_t, std::set<std::int64_t>> neighbours;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    changes.for_neighbours(i, [&](std::int64_t j) { neighbours[nodes.id(i)].insert(nodes.id(j)); });
  s.make_stars();
  quick_assert(followed == in_stars(s.b.nodes, s.stars));
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    std::set<std::int64_t> expected;
    s.stars.for_neighbours(i, [&](std::int64_t j) { expected.insert(nodes.id(j)); });
    quick_assert(expected == neighbours[nodes.id(i)]);
  }
}
END_TEST

// ------------------------------------------------------------------ slivers --------------------

namespace {

// Repairs until there are no slivers left. Returns how many nodes have moved.
std::int64_t repair(pnpbs::SliverRepair& slivers) {
  std::int64_t moved = 0;
  for (std::int64_t round = 0; round < 300 && slivers.slivers() > 0; ++round)
    moved += one_round(slivers, round);
  return moved;
}

}  // namespace

START_TEST(no_sliver_is_left) {
  Shaken s(9, 0.25);
  const Places before = places_by_id(s.b.nodes);
  ck_assert_double_lt(s.least_angle(), 10);
  pnpbs::SliverRepair slivers(s.b.nodes, s.stars, kSlivers, anywhere);
  ck_assert_int_gt(slivers.slivers(), 50);
  const std::int64_t moved = repair(slivers);
  ck_assert_int_eq(slivers.slivers(), 0);
  ck_assert_int_gt(moved, 50);
  s.make_stars();
  ck_assert_double_ge(s.least_angle(), kSlivers.repair_below - 1e-9);
  double farthest = 0;
  for (std::int64_t i = 0; i < s.b.nodes.count; ++i) {
    const double way = pnpbs::distance<3>(s.b.nodes.position(i), before.at(s.b.nodes.id(i)));
    if (!s.b.nodes.moves(i)) ck_assert_double_eq(way, 0);
    farthest = std::max(farthest, way);
  }
  ck_assert_double_lt(farthest, 1);
}
END_TEST

// The stars that a repair leaves equal newly built stars, in the same order.
START_TEST(stars_that_are_left) {
  using volume_tetrahedra::Star;
  Shaken s(9, 0.25);
  const auto all = [&] {
    std::map<std::int64_t, Star> stars;
    for (std::int64_t i = 0; i < s.b.nodes.count; ++i)
      stars[s.b.nodes.id(i)] = volume_tetrahedra::star_by_ids(s.b.nodes, s.stars, i);
    return stars;
  };
  const std::map<std::int64_t, Star> before = all();
  pnpbs::SliverRepair slivers(s.b.nodes, s.stars, kSlivers, anywhere);
  ck_assert_int_gt(repair(slivers), 50);
  slivers.write_stars(s.stars);
  const std::map<std::int64_t, Star> left = all();
  quick_assert(left != before);
  s.make_stars();
  quick_assert(left == all());
}
END_TEST

// Every round reduces the sum of the penalties, even if several nodes move at once.
START_TEST(rounds_only_help) {
  Shaken s(9, 0.3);
  const pnpbs::SmallAngles small(kSlivers.penalty_below());
  std::set<std::int64_t> moving;
  for (std::int64_t i = 0; i < s.b.nodes.count; ++i)
    if (s.b.nodes.moves(i)) moving.insert(s.b.nodes.id(i));
  const auto penalty = [&] {
    double sum = 0;
    s.make_stars();
    const Places places = places_by_id(s.b.nodes);
    for (const Ids& t : in_stars(s.b.nodes, s.stars)) {
      if (std::any_of(t.begin(), t.end(), [&](std::int64_t id) { return moving.contains(id); }))
        sum += small.penalty(corners_of(t, places)) / 4;
    }
    return sum;
  };
  double last = penalty();
  int several = 0;  // rounds in which more than one moved
  for (std::int64_t round = 0; round < 8; ++round) {
    pnpbs::SliverRepair slivers(s.b.nodes, s.stars, kSlivers, anywhere);
    const std::int64_t moved = one_round(slivers, round);
    ck_assert_int_gt(moved, 0);
    several += moved > 1;
    const double now = penalty();
    ck_assert_double_lt(now, last);
    last = now;
  }
  ck_assert_int_ge(several, 6);
}
END_TEST

START_TEST(nodes_keep_off_where_they_must) {
  Shaken s(9, 0.25);
  const Places before = places_by_id(s.b.nodes);
  const auto allowed = [&](std::int64_t i, const Point<3>& x) {
    return s.b.nodes.position(i)[0] > 4 && x[0] > 4;
  };
  pnpbs::SliverRepair slivers(s.b.nodes, s.stars, kSlivers, allowed);
  ck_assert_int_gt(repair(slivers), 20);
  for (const auto& [id, x] : places_by_id(s.b.nodes)) {
    quick_assert(before.at(id)[0] > 4 || x == before.at(id));
    quick_assert(before.at(id)[0] <= 4 || x[0] > 4);
  }
}
END_TEST

// ------------------------------------------------------------------ the same everywhere --------

START_TEST(the_same_in_another_order) {
  Shaken s(8, 0.25), other(8, 0.25, 6);
  quick_assert(s.b.nodes.id(0) != other.b.nodes.id(0) || s.b.nodes.id(9) != other.b.nodes.id(9));
  pnpbs::SliverRepair slivers(s.b.nodes, s.stars, kSlivers, anywhere);
  pnpbs::SliverRepair other_slivers(other.b.nodes, other.stars, kSlivers, anywhere);
  ck_assert_int_gt(repair(slivers), 20);
  repair(other_slivers);
  quick_assert(places_by_id(s.b.nodes) == places_by_id(other.b.nodes));
}
END_TEST

// Returns the changes that the owner of the nodes sends to the other rank.
std::vector<pnpbs::ChangedTetrahedron> news_of(const pnpbs::SliverRepair& slivers) {
  std::vector<pnpbs::ChangedTetrahedron> news;
  for (const std::int32_t i : slivers.moved_nodes()) {
    const auto more = slivers.changes_of(i);
    news.insert(news.end(), more.begin(), more.end());
  }
  return news;
}

// Two ranks that own one half each, and exchange changes.
START_TEST(the_same_from_two_halves) {
  Shaken whole(9, 0.3), low(9, 0.3), high(9, 0.3);
  const auto is_low = [](const Point<3>& x) { return x[1] < 4.9; };
  for (std::int64_t i = 0; i < low.b.nodes.count; ++i) {
    low.b.nodes.owned(i) = is_low(low.b.nodes.position(i));
    high.b.nodes.owned(i) = !is_low(high.b.nodes.position(i));
  }
  pnpbs::SliverRepair all(whole.b.nodes, whole.stars, kSlivers, anywhere),
      of_low(low.b.nodes, low.stars, kSlivers, anywhere),
      of_high(high.b.nodes, high.stars, kSlivers, anywhere);
  std::int64_t moved_low = 0, moved_high = 0;
  for (std::int64_t round = 0; round < 30; ++round) {
    const std::int64_t moved = one_round(all, round);
    draw_on_both(of_low, of_high, round);
    const std::int64_t here = of_low.move(), there = of_high.move();
    ck_assert_int_eq(here + there, moved);
    moved_low += here;
    moved_high += there;
    of_low.follow(news_of(of_high));
    of_high.follow(news_of(of_low));
    quick_assert(places_by_id(low.b.nodes) == places_by_id(whole.b.nodes));
    quick_assert(places_by_id(high.b.nodes) == places_by_id(whole.b.nodes));
  }
  ck_assert_int_gt(moved_low, 10);
  ck_assert_int_gt(moved_high, 10);
}
END_TEST

// ------------------------------------------------------------------ sweeps ---------------------

START_TEST(sweeps_go_to_the_mean) {
  Shaken s(6, 0.2);
  pnpbs::Nodes<3>& nodes = s.b.nodes;
  const Places before = places_by_id(s.b.nodes);
  std::map<std::int64_t, std::set<std::int64_t>> neighbours;
  for (const Ids& t : in_stars(s.b.nodes, s.stars))
    for (const std::int64_t i : t)
      for (const std::int64_t j : t)
        if (i != j) neighbours[i].insert(j);
  pnpbs::Field<3> proposed;
  pnpbs::reserve_field<3>(proposed, "proposed", nodes.count);
  pnpbs::sweep_to_means(nodes, s.stars, 0.6, proposed, [](std::int64_t, const Point<3>& x) {
    return x[2] < 4;  // decides by the goal
  });
  std::int64_t went = 0, stayed = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    const Point<3> x = before.at(nodes.id(i));
    Point<3> goal{};
    const std::set<std::int64_t>& around = neighbours[nodes.id(i)];
    for (const std::int64_t j : around)
      for (std::size_t k = 0; k < 3; ++k)
        goal[k] += before.at(j)[k] / static_cast<double>(around.size());
    for (std::size_t k = 0; k < 3; ++k) goal[k] = x[k] + 0.6 * (goal[k] - x[k]);
    const bool may = nodes.moves(i) && goal[2] < 4;
    ck_assert_double_lt(pnpbs::distance<3>(nodes.position(i), may ? goal : x),
                        may ? 1e-12 : 1e-300);
    ++(may ? went : stayed);
  }
  ck_assert_int_gt(went, 20);
  ck_assert_int_gt(stayed, 20);
}
END_TEST

// Ranks do not move ghosts; their owners do.
START_TEST(sweeps_move_owned_nodes_alone) {
  Shaken s(6, 0.2);
  pnpbs::Nodes<3>& nodes = s.b.nodes;
  std::int64_t own = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    nodes.owned(i) = nodes.position(i)[0] < 2.5;
    own += nodes.owned(i) && nodes.moves(i);
  }
  const Places before = places_by_id(nodes);
  pnpbs::Field<3> proposed;
  pnpbs::reserve_field<3>(proposed, "proposed", nodes.count);
  const pnpbs::NodesWorkedFor swept = pnpbs::sweep_to_means(
      nodes, s.stars, 0.6, proposed, [](std::int64_t, const Point<3>&) { return true; });
  ck_assert_int_gt(own, 20);
  ck_assert_int_lt(own, nodes.count);
  ck_assert_int_eq(swept.all, own);
  ck_assert_int_eq(swept.owned, own);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    ck_assert_int_eq(nodes.position(i) == before.at(nodes.id(i)),
                     !nodes.owned(i) || !nodes.moves(i));
}
END_TEST

TEST_SUITE(test_slivers) {
  return run_kernel_suite(
      "slivers",
      {known_angles, angles_of_any_tetrahedron, small_node_set_is_found, surely_no_small_angles,
       stars_follow_nodes, no_sliver_is_left, stars_that_are_left, rounds_only_help,
       nodes_keep_off_where_they_must, the_same_in_another_order, the_same_from_two_halves,
       sweeps_go_to_the_mean, sweeps_move_owned_nodes_alone});
}
