// SPDX-License-Identifier: BSD-3-Clause
// Background tree, buckets and adjacency lists, against all cells and all pairs.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/counting_sort.hpp"
#include "bubbles.hpp"
#include "geometry/expect_error.hpp"
#include "run_kernel_suite.hpp"

namespace {

template <int Dim>
bool holds(const Box<Dim>& box, const Point<Dim>& x, double rim) {
  for (int k = 0; k < Dim; ++k)
    if (x[k] < box.low[k] - rim || x[k] > box.high[k] + rim) return false;
  return true;
}

template <int Dim>
bool meet(const Box<Dim>& a, const Box<Dim>& b, double rim) {
  for (int k = 0; k < Dim; ++k)
    if (a.high[k] < b.low[k] - rim || a.low[k] > b.high[k] + rim) return false;
  return true;
}

// ------------------------------------------------------------------ the tree -------------------

// A spacing that is fine near an off-centre point and 2000 times coarser far away.
template <int Dim>
double steep(const Point<Dim>& x) {
  double square = 0;
  for (int k = 0; k < Dim; ++k) square += (x[k] - 0.31) * (x[k] - 0.31);
  return 0.0002 + (Dim == 2 ? 0.2 : 0.4) * std::sqrt(square);
}

template <int Dim>
pnpbs::BackgroundTree<Dim> steep_tree() {
  Bubbles<Dim> b;
  b.box.low.fill(-3);
  b.box.high.fill(2);
  b.box.high[0] = 1;  // not a cube
  b.grow_tree(steep<Dim>, 2);
  return b.tree;
}

template <int Dim>
void expect_leaves_fill_the_root() {
  const auto tree = steep_tree<Dim>();
  ck_assert_int_gt(tree.leaf_count(), 300);
  double volume = 0;
  std::vector<char> met(static_cast<std::size_t>(tree.cell_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const std::int32_t c = tree.leaf_cell(leaf);
    ck_assert_int_eq(tree.cell(c).leaf, leaf);
    ck_assert_int_lt(tree.cell(c).first_child, 0);
    quick_assert(!met[static_cast<std::size_t>(c)]);
    met[static_cast<std::size_t>(c)] = 1;
    volume += std::pow(tree.cell_side(c) / tree.side(), Dim);
  }
  ck_assert_double_eq_tol(volume, 1, 1e-12);
  for (std::int32_t c = 0; c < tree.cell_count(); ++c)
    quick_assert(met[static_cast<std::size_t>(c)] == (tree.cell(c).first_child < 0));
  // The box lies strictly inside the root.
  for (int k = 0; k < Dim; ++k) {
    ck_assert_double_lt(tree.origin()[k], -3);
    ck_assert_double_gt(tree.origin()[k] + tree.side(), 2);
  }
}

// Returns the bits of the cell indices, interleaved with those of dimension 0 last.
template <int Dim>
std::vector<bool> morton_key(const pnpbs::BackgroundTree<Dim>& tree, std::int32_t leaf) {
  const auto& cell = tree.cell(tree.leaf_cell(leaf));
  std::vector<bool> key;
  for (int bit = cell.depth - 1; bit >= 0; --bit)
    for (int k = Dim - 1; k >= 0; --k)
      key.push_back((cell.index[static_cast<std::size_t>(k)] >> bit) & 1);
  return key;
}

template <int Dim>
void expect_morton_order() {
  const auto tree = steep_tree<Dim>();
  for (std::int32_t leaf = 1; leaf < tree.leaf_count(); ++leaf)
    quick_assert(morton_key<Dim>(tree, leaf - 1) < morton_key<Dim>(tree, leaf));
}

template <int Dim>
void expect_points_in_their_leaves() {
  const auto tree = steep_tree<Dim>();
  Random random(41);
  Box<Dim> root;
  for (int k = 0; k < Dim; ++k) {
    root.low[k] = tree.origin()[k];
    root.high[k] = tree.origin()[k] + tree.side();
  }
  const double rim = 1e-14 * tree.side();
  const auto expect_found = [&](const Point<Dim>& x) {
    const std::int32_t leaf = tree.leaf_at(x);
    quick_assert(holds<Dim>(tree.cell_box(tree.leaf_cell(leaf)), x, rim));
    quick_assert(tree.leaf_holds(leaf, x));
    for (int other = 0; other < 20; ++other) {
      const auto o = static_cast<std::int32_t>(random.below(tree.leaf_count()));
      quick_assert(o == leaf || !tree.leaf_holds(o, x));
    }
    for (std::int32_t o = std::max(0, leaf - 8); o < std::min(tree.leaf_count(), leaf + 9); ++o)
      quick_assert(tree.leaf_holds(o, x) == (o == leaf));
  };
  for (int trial = 0; trial < 5000; ++trial) expect_found(random.point<Dim>(root));
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const std::int32_t c = tree.leaf_cell(leaf);
    ck_assert_int_eq(tree.leaf_at(tree.cell_centre(c)), leaf);
    const Box<Dim> box = tree.cell_box(c);
    bool at_rim = false;
    for (int k = 0; k < Dim; ++k) at_rim = at_rim || box.high[k] >= root.high[k] - rim;
    expect_found(box.low);
    if (!at_rim) expect_found(box.high);
  }
  // Points outside the root belong to the nearest leaf.
  Point<Dim> far;
  far.fill(1e9);
  Point<Dim> corner;
  for (int k = 0; k < Dim; ++k) corner[k] = root.high[k] - 1e-6;
  ck_assert_int_eq(tree.leaf_at(far), tree.leaf_at(corner));
  far.fill(-1e9);
  for (int k = 0; k < Dim; ++k) corner[k] = root.low[k] + 1e-6;
  ck_assert_int_eq(tree.leaf_at(far), tree.leaf_at(corner));
}

template <int Dim>
void expect_leaves_in_boxes() {
  const auto tree = steep_tree<Dim>();
  Random random(42);
  for (int trial = 0; trial < 300; ++trial) {
    const double half = 2.5 * std::pow(random.between(0, 1), 4);
    Box<Dim> box;
    for (int k = 0; k < Dim; ++k) {
      const double middle = random.between(-3.2, 2.2);
      box.low[k] = middle - half;
      box.high[k] = middle + half;
    }
    if (trial % 3 == 0)  // a box that touches leaves exactly
      box =
          tree.cell_box(tree.leaf_cell(static_cast<std::int32_t>(random.below(tree.leaf_count()))));
    std::vector<std::int32_t> found;
    tree.for_leaves_in(box, [&](std::int32_t leaf) { found.push_back(leaf); });
    std::vector<std::int32_t> expected;
    for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
      if (meet<Dim>(tree.cell_box(tree.leaf_cell(leaf)), box, 0)) expected.push_back(leaf);
    quick_assert(found == expected);
  }
}

// ------------------------------------------------------------------ lists ----------------------

// Returns the ids of the listed neighbours, for each node in the order of ids.
template <int Dim>
std::vector<std::pair<std::int64_t, std::vector<std::int64_t>>> listed(const Bubbles<Dim>& b) {
  std::vector<std::pair<std::int64_t, std::vector<std::int64_t>>> lists;
  for (std::int64_t i = 0; i < b.nodes.count; ++i) {
    lists.push_back({b.nodes.id(i), {}});
    b.lists.for_neighbours(i,
                           [&](std::int64_t j) { lists.back().second.push_back(b.nodes.id(j)); });
  }
  std::sort(lists.begin(), lists.end());
  return lists;
}

bool any_two(std::int64_t, std::int64_t) { return true; }
bool not_both_odd(std::int64_t a, std::int64_t b) { return a % 2 == 0 || b % 2 == 0; }

template <int Dim>
void expect_all_pairs(const Bubbles<Dim>& b, double radius,
                      bool (*visible)(std::int64_t, std::int64_t) = any_two) {
  std::vector<Bubble<Dim>> all = b.bubbles();
  std::sort(all.begin(), all.end(),
            [](const auto& one, const auto& other) { return one.id < other.id; });
  const auto lists = listed<Dim>(b);
  ck_assert_uint_eq(lists.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ck_assert_int_eq(lists[i].first, all[i].id);
    std::vector<std::int64_t> expected;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (j != i && visible(all[i].id, all[j].id) &&
          pnpbs::distance<Dim>(all[i].x, all[j].x) < radius * 0.5 * (all[i].d + all[j].d))
        expected.push_back(all[j].id);
    quick_assert_msg(lists[i].second == expected, "%zu neighbours listed instead of %zu",
                     lists[i].second.size(), expected.size());
  }
}

// Compares the lists with all pairs, with buckets of a tree for spacing d. Another order in memory
// must give the same lists.
template <int Dim>
void expect_lists(const std::vector<Bubble<Dim>>& bubbles, const SpacingFunction<Dim>& d,
                  double radius) {
  Bubbles<Dim> b;
  b.grow_tree(d);
  b.set(bubbles);
  b.list(radius);
  expect_all_pairs<Dim>(b, radius);
  const auto before = listed<Dim>(b);
  std::vector<Bubble<Dim>> mixed = bubbles;
  Random(43).shuffle(mixed);
  b.set(mixed);
  b.list(radius);
  quick_assert(listed<Dim>(b) == before);
}

template <int Dim>
void expect_random_sets() {
  Random random(44);
  const SpacingFunction<Dim> constant = [](const Point<Dim>&) { return Dim == 2 ? 0.05 : 0.12; };
  for (const double radius : {1.5, 1.7, 3.0})
    for (const double variation : {0.0, 0.3})
      expect_lists<Dim>(random_bubbles<Dim>(random, 1200, constant, variation), constant, radius);
}

// d varies by a factor of 100 without a limit on its growth, and jumps.
template <int Dim>
void expect_graded_sets() {
  Random random(45);
  constexpr double kFine = Dim == 2 ? 0.003 : 0.02;
  const SpacingFunction<Dim> ramp = [](const Point<Dim>& x) { return kFine * std::pow(100, x[0]); };
  const SpacingFunction<Dim> jump = [](const Point<Dim>& x) {
    return x[0] < 0.43 ? kFine : 100 * kFine;
  };
  // The tree is built without information about the sizes of these bubbles.
  const SpacingFunction<Dim> blind = [](const Point<Dim>&) { return 0.05; };
  for (const auto& d : {ramp, jump}) {
    const auto bubbles = random_bubbles<Dim>(random, 1500, d);
    expect_lists<Dim>(bubbles, d, 1.7);
    expect_lists<Dim>(bubbles, blind, 1.7);
  }
}

// Dense clusters, between which most buckets are empty.
template <int Dim>
void expect_clusters() {
  Random random(46);
  const SpacingFunction<Dim> d = [](const Point<Dim>&) { return 0.03; };
  std::vector<Bubble<Dim>> bubbles = random_bubbles<Dim>(random, 900, d);
  std::vector<Point<Dim>> centres;
  for (int c = 0; c < 5; ++c) centres.push_back(random.point<Dim>(unit_box<Dim>()));
  for (std::size_t i = 0; i < bubbles.size(); ++i)
    for (int k = 0; k < Dim; ++k)
      bubbles[i].x[k] =
          std::clamp(centres[i % 5][k] + 0.06 * (bubbles[i].x[k] - 0.5), 1e-9, 1 - 1e-9);
  expect_lists<Dim>(bubbles, d, 1.7);
  // All nodes are in one bucket.
  expect_lists<Dim>(
      bubbles, [](const Point<Dim>&) { return 10.0; }, 1.7);
}

template <int Dim>
void expect_any_count() {
  Random random(47);
  const SpacingFunction<Dim> d = [](const Point<Dim>&) { return 0.2; };
  for (const std::int64_t n : {0, 1, 2, 3, 7, 8, 9, 63, 64, 65, 511, 512, 513, 1025}) {
    expect_lists<Dim>(random_bubbles<Dim>(random, n, d), d, 1.7);
    expect_lists<Dim>(
        random_bubbles<Dim>(random, n, d), [](const Point<Dim>&) { return Dim == 2 ? 0.01 : 0.03; },
        1.7);
  }
}

// One set of buckets and lists is reused while positions, sizes and the number of nodes change.
template <int Dim>
void expect_lists_after_changes() {
  Random random(48);
  const SpacingFunction<Dim> d = [](const Point<Dim>& x) { return 0.03 + 0.1 * x[0]; };
  Bubbles<Dim> b;
  b.grow_tree(d);
  std::vector<Bubble<Dim>> bubbles = random_bubbles<Dim>(random, 700, d);
  for (int round = 0; round < 8; ++round) {
    b.set(bubbles);
    b.list(1.7);
    expect_all_pairs<Dim>(b, 1.7);
    b.list(1.5);
    expect_all_pairs<Dim>(b, 1.5);
    bubbles = b.bubbles();
    for (Bubble<Dim>& bubble : bubbles) {
      for (int k = 0; k < Dim; ++k)
        bubble.x[k] = std::clamp(bubble.x[k] + random.between(-0.1, 0.1), 1e-9, 1 - 1e-9);
      bubble.d *= round == 4 ? 3 : random.between(0.8, 1.3);
    }
    if (round == 2) bubbles.resize(90);
    if (round == 5)
      for (const Bubble<Dim>& more : random_bubbles<Dim>(random, 400, d)) {
        bubbles.push_back(more);
        bubbles.back().id += 1'000'000'000'000;
      }
    if (round == 6) {
      b.grow_tree([](const Point<Dim>& x) { return 0.1 * x[1] + 0.01; });
    }
  }
}

}  // namespace

START_TEST(leaves_fill_the_root) {
  expect_leaves_fill_the_root<2>();
  expect_leaves_fill_the_root<3>();
}
END_TEST

START_TEST(leaves_are_in_morton_order) {
  expect_morton_order<2>();
  expect_morton_order<3>();
}
END_TEST

START_TEST(points_are_found_in_their_leaves) {
  expect_points_in_their_leaves<2>();
  expect_points_in_their_leaves<3>();
}
END_TEST

START_TEST(leaves_in_a_box) {
  expect_leaves_in_boxes<2>();
  expect_leaves_in_boxes<3>();
}
END_TEST

START_TEST(nodes_are_sorted_by_bucket) {
  Random random(49);
  const SpacingFunction<2> d = [](const Point<2>& x) { return 0.01 + 0.1 * x[1]; };
  Bubbles<2> b;
  b.grow_tree(d);
  b.set(random_bubbles<2>(random, 800, d));
  b.list(1.7);
  ck_assert_int_eq(b.buckets.begin(0), 0);
  ck_assert_int_eq(b.buckets.end(b.tree.leaf_count() - 1), b.nodes.count);
  for (std::int32_t leaf = 0; leaf < b.tree.leaf_count(); ++leaf) {
    double min = std::numeric_limits<double>::infinity();
    for (std::int32_t i = b.buckets.begin(leaf); i < b.buckets.end(leaf); ++i) {
      ck_assert_int_eq(b.tree.leaf_at(b.nodes.position(i)), leaf);
      ck_assert_int_eq(b.buckets.bucket_of(i), leaf);
      min = std::min(min, b.nodes.d(i));
    }
    quick_assert(b.buckets.min_spacing(leaf) == min);
    // Links are symmetric and sorted, and each bucket is linked to itself.
    std::vector<std::int32_t> others;
    b.buckets.for_neighbours(leaf, [&](std::int32_t other) { others.push_back(other); });
    quick_assert(std::is_sorted(others.begin(), others.end()));
    quick_assert(std::set<std::int32_t>(others.begin(), others.end()).size() == others.size());
    quick_assert(std::count(others.begin(), others.end(), leaf) == 1);
    for (std::int32_t other : others) {
      bool back = false;
      b.buckets.for_neighbours(other, [&](std::int32_t o) { back = back || o == leaf; });
      quick_assert(back);
    }
  }
}
END_TEST

// Large enough to give each thread a part. Entries with key -1 are left out.
START_TEST(counting_sort_is_stable) {
  Random random(60);
  for (const std::int64_t n : {0, 1, 1000, 90001})
    for (const std::int32_t min : {-1, 0}) {
      std::vector<std::int32_t> keys, order;
      for (std::int32_t i = 0; i < n; ++i) {
        keys.push_back(static_cast<std::int32_t>(random.below(300 - min)) + min);
        if (keys.back() >= 0) order.push_back(i);
      }
      std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return keys[static_cast<std::size_t>(a)] < keys[static_cast<std::size_t>(b)];
      });
      const auto key = [&](std::int64_t i) { return keys[static_cast<std::size_t>(i)]; };
      pnpbs::CountingSort sorted(n, 300, key);
      std::vector<std::int32_t> found(order.size(), -1);
      sorted.for_places(key, [&](std::int64_t i, std::int32_t place) {
        found[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(i);
      });
      quick_assert(found == order);
      for (std::int32_t k = 0; k <= 300; ++k)
        quick_assert(
            sorted.start()[static_cast<std::size_t>(k)] ==
            std::count_if(order.begin(), order.end(), [&](std::int32_t i) { return key(i) < k; }));
      ck_assert_int_eq(sorted.in_order(),
                       std::is_sorted(keys.begin(), keys.end()) && (n == 0 || keys[0] >= 0));
    }
}
END_TEST

START_TEST(counting_sort_tells_order) {
  std::vector<std::int32_t> keys;
  for (std::int32_t i = 0; i < 90001; ++i) keys.push_back(i / 4);
  const auto in_order = [&] {
    return pnpbs::CountingSort(static_cast<std::int64_t>(keys.size()), 23000,
                               [&](std::int64_t i) { return keys[static_cast<std::size_t>(i)]; })
        .in_order();
  };
  ck_assert(in_order());
  for (std::size_t i = 4; i < keys.size(); i += 500) {
    std::swap(keys[i - 1], keys[i]);
    quick_assert(!in_order());
    std::swap(keys[i - 1], keys[i]);
  }
}
END_TEST

// Buckets may reuse data although nodes were dropped, appended or moved in between.
START_TEST(buckets_of_kept_nodes) {
  Random random(70);
  const SpacingFunction<2> d = [](const Point<2>& x) { return 0.02 + 0.05 * x[0]; };
  Bubbles<2> b;
  b.grow_tree(d);
  b.set(random_bubbles<2>(random, 800, d));
  for (int round = 0; round < 5; ++round) {
    b.list(1.7);
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      ck_assert_int_eq(b.tree.leaf_at(b.nodes.position(i)), b.buckets.bucket_of(i));
    ck_assert(b.buckets.knows(b.nodes.count - 1));
    pnpbs::View<std::int32_t>& places = b.nodes.order_scratch();
    std::vector<std::int32_t> buckets;
    for (std::int32_t i = 0; i < b.nodes.count; ++i) {
      if (random.below(5) == 0) continue;
      places(static_cast<std::int64_t>(buckets.size())) = i;
      buckets.push_back(b.buckets.bucket_of(i));
    }
    const auto kept = static_cast<std::int64_t>(buckets.size());
    b.nodes.keep(places, kept);
    b.buckets.keep(places, kept);
    for (std::int64_t i = 0; i < kept; ++i)
      quick_assert(b.buckets.bucket_of(i) == buckets[static_cast<std::size_t>(i)]);
    b.nodes.append(random.point<2>(b.box), 0.03, 1000 + round, 0, pnpbs::Carrier::free, -1);
    ck_assert(b.buckets.knows(kept - 1));
    ck_assert(!b.buckets.knows(kept));
    b.nodes.set_position(random.below(kept), random.point<2>(b.box));
  }
}
END_TEST

std::vector<std::int64_t> listed_by(const pnpbs::AdjacencyList<3>& lists, std::int64_t i) {
  std::vector<std::int64_t> listed;
  lists.for_neighbours(i, [&](std::int64_t j) { listed.push_back(j); });
  return listed;
}

// Builds lists of owned nodes first, then of some ghosts (one twice, and one owned node), then of
// all.
START_TEST(lists_of_ghosts_come_later) {
  Random random(51);
  const SpacingFunction<3> d = [](const Point<3>& x) { return 0.06 + 0.05 * x[0]; };
  const auto visible = [](std::int64_t i, std::int64_t j) { return (i + j) % 5 != 0; };
  Bubbles<3> b;
  b.grow_tree(d);
  b.set(random_bubbles<3>(random, 3000, d));
  b.list(1.6, visible);
  const pnpbs::AdjacencyList<3> whole = b.lists;
  for (std::int64_t i = 0; i < b.nodes.count; ++i) b.nodes.owned(i) = b.nodes.position(i)[1] < 0.5;
  b.list(1.6, visible, pnpbs::ListsOf::owned_nodes);
  std::vector<char> has(b.nodes.owned.data(), b.nodes.owned.data() + b.nodes.count);
  const auto expect_lists = [&] {
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      const bool is_listed = has[static_cast<std::size_t>(i)] != 0;
      quick_assert(b.lists.has(i) == is_listed);
      quick_assert(listed_by(b.lists, i) ==
                   (is_listed ? listed_by(whole, i) : std::vector<std::int64_t>()));
    }
  };
  expect_lists();
  std::vector<std::int32_t> some, all;
  for (std::int32_t i = 0; i < b.nodes.count; ++i) {
    all.push_back(i);
    if (random.below(20) == 0) some.push_back(i);
  }
  some.push_back(some.front());
  for (const std::vector<std::int32_t>& more : {some, all}) {
    b.lists.add(b.nodes, b.buckets, Bubbles<3>::Visibility<decltype(visible)>{visible}, more);
    for (const std::int32_t i : more) has[static_cast<std::size_t>(i)] = 1;
    expect_lists();
  }
}
END_TEST

START_TEST(lists_of_random_sets) {
  expect_random_sets<2>();
  expect_random_sets<3>();
}
END_TEST

START_TEST(lists_of_graded_sets) {
  expect_graded_sets<2>();
  expect_graded_sets<3>();
}
END_TEST

START_TEST(lists_of_clusters) {
  expect_clusters<2>();
  expect_clusters<3>();
}
END_TEST

START_TEST(lists_of_any_number_of_nodes) {
  expect_any_count<2>();
  expect_any_count<3>();
}
END_TEST

START_TEST(lists_after_changes) {
  expect_lists_after_changes<2>();
  expect_lists_after_changes<3>();
}
END_TEST

START_TEST(lists_of_pairs_that_see_each_other) {
  Random random(50);
  const SpacingFunction<2> d = [](const Point<2>&) { return 0.05; };
  Bubbles<2> b;
  b.grow_tree(d);
  b.set(random_bubbles<2>(random, 700, d));
  b.list(1.7, [&b](std::int64_t i, std::int64_t j) {
    return not_both_odd(b.nodes.id(i), b.nodes.id(j));
  });
  expect_all_pairs<2>(b, 1.7, not_both_odd);
}
END_TEST

// Blocks are padded with the index behind the last node. Coincident nodes are neighbours.
START_TEST(blocks_are_padded) {
  Bubbles<2> b;
  b.grow_tree([](const Point<2>&) { return 0.1; });
  b.set({{{0.5, 0.5}, 0.1, 3}, {{0.5, 0.5}, 0.1, 1}, {{0.9, 0.5}, 0.1, 2}});
  b.list(1.7);
  expect_all_pairs<2>(b, 1.7);
  ck_assert_int_eq(b.lists.block_count(), 1);
  const pnpbs::ListBlock block = b.lists.block(0);
  ck_assert_int_eq(block.length, 1);
  std::int64_t padded = 0;
  for (int lane = 0; lane < pnpbs::kLanes; ++lane) padded += block.entries[lane] == b.nodes.count;
  ck_assert_int_eq(padded, pnpbs::kLanes - 2);
}
END_TEST

START_TEST(ranks_hold_what_32_bits_number) {
  pnpbs::Nodes<2> nodes;
  const std::initializer_list<const char*> parts = {"a rank would have 2147483600 nodes",
                                                    "can have 2147483584: use more ranks"};
  for (const bool with_room : {false, true})
    expect_error(pnpbs::ErrorKind::memory, parts, [&] {
      with_room ? nodes.reserve_with_room(2147483600) : nodes.reserve(2147483600);
    });
}
END_TEST

TEST_SUITE(test_neighbors) {
  return run_kernel_suite(
      "neighbors",
      {leaves_fill_the_root, leaves_are_in_morton_order, points_are_found_in_their_leaves,
       leaves_in_a_box, nodes_are_sorted_by_bucket, counting_sort_is_stable,
       counting_sort_tells_order, buckets_of_kept_nodes, lists_of_random_sets, lists_of_graded_sets,
       lists_of_clusters, lists_of_any_number_of_nodes, lists_after_changes,
       lists_of_ghosts_come_later, lists_of_pairs_that_see_each_other, blocks_are_padded,
       ranks_hold_what_32_bits_number});
}
