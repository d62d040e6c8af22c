// SPDX-License-Identifier: BSD-3-Clause
// Stars found before nodes moved. Kept stars and newly found ones together equal the stars built
// from scratch, in the same order, for any displacement of the nodes.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "delaunay/volume/previous_stars.hpp"
#include "run_kernel_suite.hpp"
#include "volume_box.hpp"
#include "volume_tetrahedra.hpp"

using pnpbs::PreviousStars;
using pnpbs::VolumeStarInput;
using pnpbs::VolumeStars;
using volume_tetrahedra::Star;

namespace {

const pnpbs::KnownRegion<3> kEverywhere;

std::vector<Bubble<3>> shaken(const volume_box::Crystal& crystal, double by) {
  std::vector<Bubble<3>> bubbles = volume_box::sites(crystal);
  volume_box::shake(bubbles, by);
  return bubbles;
}

// Nodes with lists, in random order.
struct Listed {
  Bubbles<3> b;

  explicit Listed(const volume_box::Crystal& crystal) {
    b.box = crystal.box();
    b.grow_tree([](const Point<3>&) { return 1.0; }, 3);
  }
  void put(std::vector<Bubble<3>> bubbles, Random& random) {
    random.shuffle(bubbles);
    b.set(bubbles);
    b.list(1.6);
  }
  VolumeStarInput input() const { return volume_tetrahedra::input_of(b, kEverywhere); }
  std::vector<char> owned() const { return owned_; }
  // Assigns the nodes beyond this plane to another rank.
  void give_away(double beyond) {
    owned_.assign(static_cast<std::size_t>(b.nodes.count), 1);
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      b.nodes.owned(i) = b.nodes.position(i)[0] <= beyond;
      owned_[static_cast<std::size_t>(i)] = b.nodes.owned(i);
    }
  }
  std::map<std::int64_t, Star> by_id(const VolumeStars& stars) const {
    std::map<std::int64_t, Star> found;
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      if (b.nodes.owned(i))
        found[b.nodes.id(i)] = volume_tetrahedra::star_by_ids(b.nodes, stars, i);
    return found;
  }
  std::map<std::int64_t, Star> found_anew() const {
    VolumeStars stars;
    stars.build(input());
    return by_id(stars);
  }

 private:
  std::vector<char> owned_;
};

// Places the bubbles, assigns those beyond the plane to another rank, builds the stars and returns
// them as PreviousStars.
PreviousStars taken(Listed& listed, const std::vector<Bubble<3>>& bubbles, double beyond,
                    Random& random, std::uint64_t digest = 0) {
  listed.put(bubbles, random);
  listed.give_away(beyond);
  VolumeStars stars;
  stars.build(listed.input());
  PreviousStars before;
  before.take(listed.b.nodes, stars, digest);
  return before;
}

void move(std::vector<Bubble<3>>& bubbles, double most, Random& random) {
  for (Bubble<3>& bubble : bubbles) {
    if (!bubble.moves) continue;
    for (double& along : bubble.x) along += most * random.between(-1, 1);
  }
}

struct Count {
  std::int64_t stars, found;
};

// Moves nodes by up to `moved_by` in each direction, assigns those beyond the plane to another
// rank, and compares the stars.
Count follow(double shaken_by, double moved_by, double beyond) {
  constexpr double kFar = 1e9;
  Random random(3);
  const volume_box::Crystal crystal{9};
  std::vector<Bubble<3>> bubbles = shaken(crystal, shaken_by);
  Listed listed(crystal);
  PreviousStars before = taken(listed, bubbles, kFar, random);
  ck_assert(before.any());

  move(bubbles, moved_by, random);
  listed.put(bubbles, random);
  listed.give_away(beyond);
  VolumeStarInput input = listed.input();
  Count count{std::ssize(bubbles), 0};
  input.complete = [&](std::int64_t) {  // called where a star is to be found
#pragma omp atomic
    ++count.found;
    return true;
  };
  VolumeStars stars;
  stars.build_none(input);
  before.find_stars(input, listed.owned(), stars);
  ck_assert(!before.any());
  quick_assert(listed.by_id(stars) == listed.found_anew());
  return count;
}

}  // namespace

START_TEST(little_moves) {
  for (const double way : {0.0, 0.001, 0.02}) {
    const Count count = follow(0.15, way, 1e9);
    // The outer layers have open stars, which are always searched.
    const std::int64_t kOpen = 6 * 2 * 10 * 10;
    ck_assert_int_lt(count.found, kOpen + (count.stars - kOpen) / 4);
  }
}
END_TEST

START_TEST(large_moves) {
  for (const double way : {0.1, 0.3, 0.6, 2.0}) follow(0.15, way, 1e9);
}
END_TEST

// Nodes of a lattice lie on common spheres, where ids decide.
START_TEST(ties) {
  follow(0, 0, 1e9);
  follow(0, 1e-15, 1e9);
  follow(0, 0.02, 1e9);
}
END_TEST

// Stars beside nodes that moved to another rank are searched again.
START_TEST(nodes_given_away) {
  for (const double beyond : {2.0, 5.0, -1.0}) follow(0.15, 0.02, beyond);
}
END_TEST

// Stars are restored, including open ones, if only the order of nodes has changed, except around
// nodes that are not known any more.
START_TEST(restore) {
  constexpr double kFar = 1e9, kBeyond = 5;
  Random random(9);
  const volume_box::Crystal crystal{8};
  const std::vector<Bubble<3>> bubbles = shaken(crystal, 0.15);
  Listed listed(crystal);
  PreviousStars before = taken(listed, bubbles, kBeyond, random, 7);
  ck_assert_uint_eq(before.digest(), 7);

  std::vector<Bubble<3>> fewer = bubbles;
  const auto lost =
      std::ranges::find_if(fewer, [](const Bubble<3>& b) { return b.x[0] > kBeyond; });
  const std::int64_t lost_id = lost->id;
  fewer.erase(lost);
  listed.put(bubbles, random);
  listed.give_away(kFar);
  const std::map<std::int64_t, Star> all = listed.found_anew();
  listed.put(fewer, random);
  listed.give_away(kBeyond);
  VolumeStars stars;
  stars.build_none(listed.input());
  before.restore(listed.input(), stars);
  ck_assert(!before.any());
  ck_assert_uint_eq(before.digest(), 0);
  std::int64_t missing = 0;
  for (std::int64_t i = 0; i < listed.b.nodes.count; ++i) {
    const Star& star = all.at(listed.b.nodes.id(i));
    const bool has_lost = std::ranges::count(star.neighbours, lost_id) > 0;
    const bool owned = listed.b.nodes.owned(i) != 0;
    ck_assert_int_eq(stars.found(i), owned && !has_lost);
    missing += owned && has_lost;
    if (stars.found(i))
      quick_assert(volume_tetrahedra::star_by_ids(listed.b.nodes, stars, i) == star);
  }
  ck_assert_int_gt(missing, 0);
}
END_TEST

// Nodes may be removed and inserted.
START_TEST(other_nodes) {
  Random random(5);
  const volume_box::Crystal crystal{8};
  std::vector<Bubble<3>> bubbles = shaken(crystal, 0.15);
  Listed listed(crystal);
  PreviousStars before = taken(listed, bubbles, 1e9, random);
  for (std::size_t k = bubbles.size() - 1; k > 0; k -= std::min<std::size_t>(k, 37)) {
    if (!bubbles[k].moves) continue;
    if (k % 2 == 0) {
      bubbles.erase(bubbles.begin() + static_cast<std::ptrdiff_t>(k));
    } else {
      bubbles.push_back(bubbles[k]);
      bubbles.back().id = 1'000'000'000'000 + static_cast<std::int64_t>(k);
      for (double& along : bubbles.back().x) along += 0.3;
    }
  }
  listed.put(bubbles, random);
  listed.give_away(1e9);
  VolumeStars stars;
  stars.build_none(listed.input());
  before.find_stars(listed.input(), listed.owned(), stars);
  quick_assert(listed.by_id(stars) == listed.found_anew());
}
END_TEST

// Stars of other nodes are rejected, so that no wrong star is kept.
START_TEST(stars_of_others) {
  Random random(7);
  const volume_box::Crystal crystal{6};
  const std::vector<Bubble<3>> bubbles = shaken(crystal, 0.1);
  Listed listed(crystal);
  listed.put(bubbles, random);
  listed.give_away(1e9);
  VolumeStars stars;
  stars.build(listed.input());
  listed.put(bubbles, random);
  PreviousStars before;
  before.take(listed.b.nodes, stars);
  ck_assert(!before.any());
}
END_TEST

TEST_SUITE(test_previous_stars) {
  return run_kernel_suite("previous_stars", {little_moves, large_moves, ties, nodes_given_away,
                                             restore, other_nodes, stars_of_others});
}
