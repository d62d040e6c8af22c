// SPDX-License-Identifier: BSD-3-Clause
// The graph of leaves and searches in it, the tree of boxes and the cells near a rank, in 2 and 3
// dimensions, against all pairs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bubbles.hpp"
#include "partition/distribution.hpp"
#include "run_kernel_suite.hpp"
#include "tree/box_tree.hpp"
#include "tree/hop_search.hpp"

namespace {

using Indices = std::vector<std::int32_t>;

// Returns the distance of two boxes, by projecting the centre of one on the other and back, axis by
// axis.
template <int Dim>
double gap_between(const Box<Dim>& a, const Box<Dim>& b) {
  Point<Dim> in_a, in_b;
  for (int k = 0; k < Dim; ++k) {
    in_a[k] = std::clamp(0.5 * (b.low[k] + b.high[k]), a.low[k], a.high[k]);
    in_b[k] = std::clamp(in_a[k], b.low[k], b.high[k]);
    in_a[k] = std::clamp(in_b[k], a.low[k], a.high[k]);
  }
  return pnpbs::distance<Dim>(in_a, in_b);
}

// ------------------------------------------------------------------ leaves ---------------------

// Returns a tree with leaves from 1/64 to 1/2 of the width of the root.
template <int Dim>
pnpbs::BackgroundTree<Dim> graded_tree() {
  Bubbles<Dim> b;
  b.grow_tree(
      [](const Point<Dim>& x) {
        return 0.008 + (Dim == 2 ? 0.1 : 0.2) * pnpbs::distance<Dim>(x, {});
      },
      2);
  return b.tree;
}

// Returns a tree in which leaves that differ by several depths touch.
template <int Dim>
pnpbs::BackgroundTree<Dim> uneven_tree() {
  Random random(84);
  pnpbs::BackgroundTree<Dim> tree;
  tree.build(unit_box<Dim>(), [&](const pnpbs::BackgroundTree<Dim>& t, std::int32_t first,
                                  std::int32_t last, std::vector<char>& split) {
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] =
          t.cell(c).depth < 2 ||
          (t.cell(c).depth < (Dim == 2 ? 7 : 5) && random.below(1 << Dim) < 2);
  });
  return tree;
}

// Returns the neighbours of each leaf: itself and all within the larger reach of two leaves, on a
// sphere also by their distance along it, for which the leaf with the larger reach counts.
template <int Dim>
std::vector<Indices> expected_links(const pnpbs::BackgroundTree<Dim>& tree,
                                    const std::vector<double>& reach,
                                    const std::vector<double>& stretch) {
  std::vector<Indices> rows(reach.size());
  for (std::size_t a = 0; a < reach.size(); ++a) {
    const Box<Dim> box = tree.cell_box(tree.leaf_cell(static_cast<std::int32_t>(a)));
    for (std::size_t b = 0; b < reach.size(); ++b) {
      double farther = std::max(reach[a], reach[b]);
      if (!stretch.empty())
        farther = std::min(farther, std::max(reach[a] / stretch[a], reach[b] / stretch[b]) *
                                        std::sqrt(stretch[a] * stretch[b]));
      const double gap =
          gap_between<Dim>(box, tree.cell_box(tree.leaf_cell(static_cast<std::int32_t>(b))));
      if (a == b || (farther > 0 && gap <= farther))
        rows[a].push_back(static_cast<std::int32_t>(b));
    }
  }
  return rows;
}

// Expects the links of every leaf, which two threads read, and that only rows that have been read
// are stored.
template <int Dim>
void expect_links(const pnpbs::BackgroundTree<Dim>& tree, const std::vector<double>& reach,
                  const std::vector<double>& stretch = {}) {
  const std::vector<Indices> expected = expected_links(tree, reach, stretch);
  const pnpbs::LeafGraph<Dim> graph(tree, reach, stretch);
  ck_assert_int_eq(graph.stored_links(), 0);
  std::size_t links = 0;
  for (std::int32_t a = 0; a < tree.leaf_count(); ++a) {
    Indices searched;
    graph.search_neighbours(
        a, [](std::int32_t) { return true; }, [&](std::int32_t b) { searched.push_back(b); });
    quick_assert(searched == expected[static_cast<std::size_t>(a)]);
    links += searched.size();
  }
  ck_assert_uint_gt(links, 2 * static_cast<std::size_t>(tree.leaf_count()));
  ck_assert_int_eq(graph.stored_links(), 0);
  // Each row is read by several threads at about the same time.
  std::vector<char> right(4 * expected.size(), 0);
  pnpbs::for_each("links", std::ssize(right), [&](std::int64_t k) {
    Indices found;
    const auto a = static_cast<std::int32_t>(k % std::ssize(expected));
    graph.for_neighbours(a, [&](std::int32_t b) { found.push_back(b); });
    right[static_cast<std::size_t>(k)] = found == expected[static_cast<std::size_t>(a)];
  });
  ck_assert(std::ranges::all_of(right, [](char is) { return is != 0; }));
  ck_assert_int_eq(graph.stored_links(), static_cast<std::int64_t>(links));
}

template <int Dim>
void expect_leaf_graphs(const pnpbs::BackgroundTree<Dim>& tree) {
  ck_assert_int_gt(tree.leaf_count(), 100);
  Random random(81);
  const auto leaves = static_cast<std::size_t>(tree.leaf_count());
  // Reaches: the width of each leaf; random, some of them zero; and so small that only touching
  // leaves are linked.
  std::vector<double> widths(leaves), any(leaves), touching(leaves, 1e-9), stretch(leaves);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    widths[leaf] = 1.01 * tree.cell_side(tree.leaf_cell(static_cast<std::int32_t>(leaf)));
    any[leaf] = random.below(4) == 0 ? 0 : std::pow(10, random.between(-3, -0.5));
    stretch[leaf] = std::pow(10, random.between(0, 1));
  }
  for (const auto& reach : {widths, any, touching}) expect_links<Dim>(tree, reach);
  expect_links<Dim>(tree, widths, stretch);
}

// Expects the numbers of hops that a search over all pairs of leaves finds.
template <int Dim>
void expect_hops(const pnpbs::BackgroundTree<Dim>& tree) {
  Random random(85);
  std::vector<double> reach;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    reach.push_back(random.below(9) == 0 ? 0.4 * tree.cell_side(tree.leaf_cell(leaf)) : 1e-9);
  const std::vector<Indices> links = expected_links(tree, reach, {});
  const pnpbs::LeafGraph<Dim> graph(tree, reach);
  for (const int hops : {0, 1, 2, 5}) {
    const Indices from{static_cast<std::int32_t>(random.below(tree.leaf_count())),
                       static_cast<std::int32_t>(random.below(tree.leaf_count()))};
    Indices expected(reach.size(), pnpbs::kUnreached), front = from;
    for (const std::int32_t leaf : from) expected[static_cast<std::size_t>(leaf)] = 0;
    for (std::size_t k = 0; k < front.size(); ++k) {
      const std::int32_t hop = expected[static_cast<std::size_t>(front[k])] + 1;
      for (const std::int32_t other : links[static_cast<std::size_t>(front[k])])
        if (hop <= hops && expected[static_cast<std::size_t>(other)] == pnpbs::kUnreached) {
          expected[static_cast<std::size_t>(other)] = hop;
          front.push_back(other);
        }
    }
    ck_assert(pnpbs::hops_from(graph, from, hops) == expected);
    ck_assert(hops < 5 || front.size() > from.size() + 50);
  }
  ck_assert_int_eq(graph.stored_links(), 0);
}

// Expects that a rank of eight, which finds its halo and lists its own nodes, stores the links of
// its own leaves only.
template <int Dim>
void expect_links_of_own_leaves() {
  constexpr int kRanks = 8, kRank = 2, kHops = 3;
  constexpr double kRadius = 1.7;
  const auto d = [](const Point<Dim>& x) {
    return (Dim == 2 ? 0.006 : 0.02) * (1 + pnpbs::distance<Dim>(x, {}));
  };
  Bubbles<Dim> b;
  b.grow_tree(d, 2);
  std::vector<pnpbs::PartitionCell<Dim>> cells;
  std::vector<std::int32_t> owner;
  std::vector<double> reach;
  for (std::int32_t leaf = 0; leaf < b.tree.leaf_count(); ++leaf) {
    const auto& cell = b.tree.cell(b.tree.leaf_cell(leaf));
    const double max = 1.3 * d(b.tree.cell_centre(b.tree.leaf_cell(leaf)));
    cells.push_back({cell.index, cell.depth, 1, max});
    owner.push_back(kRanks * leaf / b.tree.leaf_count());
    reach.push_back(pnpbs::kRoomForGrowth * kRadius * max);
  }
  const auto graph = std::make_shared<const pnpbs::LeafGraph<Dim>>(b.tree, std::move(reach));
  pnpbs::Distribution<Dim> distribution({unit_box<Dim>(), cells}, std::move(owner), kRank, kRanks);
  distribution.take_leaves(&b.tree, std::vector<char>(cells.size(), 1));
  distribution.link_leaves(graph);
  ck_assert(!distribution.halo(kHops, 1).neighbours().empty());
  std::vector<Bubble<Dim>> own;
  std::int64_t links = 0;
  for (std::int32_t leaf = 0; leaf < b.tree.leaf_count(); ++leaf) {
    if (!distribution.owns(leaf)) continue;
    const Point<Dim> x = b.tree.cell_centre(b.tree.leaf_cell(leaf));
    own.push_back({x, d(x), leaf});
    graph->search_neighbours(
        leaf, [](std::int32_t) { return true; }, [&](std::int32_t) { ++links; });
  }
  ck_assert_int_le(graph->stored_links(), links);  // The halo reads own leaves near the border.
  b.set(own);
  b.buckets.reset(graph);
  b.list(kRadius);
  ck_assert_int_gt(links, 10 * std::ssize(own));
  ck_assert_int_eq(graph->stored_links(), links);
}

// ------------------------------------------------------------------ boxes ----------------------

template <int Dim>
std::vector<Box<Dim>> random_boxes(Random& random, std::size_t n, double widest) {
  std::vector<Box<Dim>> boxes;
  for (std::size_t b = 0; b < n; ++b) {
    const Point<Dim> low = random.point<Dim>(unit_box<Dim>());
    Box<Dim> box{low, low};
    for (int k = 0; k < Dim; ++k) box.high[k] += widest * std::pow(random.between(0, 1), 6);
    if (b % 7 == 0) box.high = low;  // some are points
    boxes.push_back(box);
  }
  return boxes;
}

template <int Dim>
bool lies_in(const Point<Dim>& x, const Box<Dim>& box) {
  bool in = true;
  for (int k = 0; k < Dim; ++k) in = in && box.low[k] <= x[k] && x[k] <= box.high[k];
  return in;
}

template <int Dim>
void expect_boxes_at(const std::vector<Box<Dim>>& boxes, const pnpbs::BoxTree<Dim>& tree,
                     const Point<Dim>& x, double limit) {
  Indices holding, near, expected_holding, expected_near;
  tree.for_holding(x, [&](std::int32_t b) { holding.push_back(b); });
  tree.for_near(
      x, [=] { return limit * limit; }, [&](std::int32_t b) { near.push_back(b); });
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const double gap = gap_between<Dim>(boxes[b], {x, x});
    if (lies_in<Dim>(x, boxes[b])) expected_holding.push_back(static_cast<std::int32_t>(b));
    if (gap <= limit) expected_near.push_back(static_cast<std::int32_t>(b));
    min = std::min(min, gap);
  }
  std::sort(holding.begin(), holding.end());
  std::sort(near.begin(), near.end());
  quick_assert(holding == expected_holding);
  quick_assert(near == expected_near);
  // Finds the nearest box, with a limit that shrinks during the search.
  double nearest = std::numeric_limits<double>::infinity();
  tree.for_near(
      x, [&] { return nearest; },
      [&](std::int32_t b) {
        nearest = std::min(nearest, pnpbs::squared_gap_to(boxes[static_cast<std::size_t>(b)], x));
      });
  quick_assert(boxes.empty() || std::fabs(std::sqrt(nearest) - min) < 1e-14);
}

template <int Dim>
void expect_box_queries() {
  Random random(82);
  for (const std::size_t n : {0, 1, 4, 5, 700}) {
    const std::vector<Box<Dim>> boxes = random_boxes<Dim>(random, n, 0.3);
    const pnpbs::BoxTree<Dim> tree(boxes);
    for (int trial = 0; trial < 400; ++trial) {
      Point<Dim> x = random.point<Dim>({pnpbs::box_around<Dim>({}, 0.2).low, unit_box<Dim>().high});
      // The corner of a box, which belongs to it.
      if (trial % 5 == 0 && n > 0) x = boxes[static_cast<std::size_t>(trial) % n].high;
      expect_boxes_at<Dim>(boxes, tree, x, 0.15 * random.between(0, 1));
    }
  }
}

// Expects that every box lies in one of the cover, whose size is not much more than requested.
template <int Dim>
void expect_cover() {
  Random random(83);
  std::vector<Box<Dim>> boxes = random_boxes<Dim>(random, 500, 0.03);
  constexpr std::size_t kLong = Dim - 1;  // longer by a factor of 8
  for (Box<Dim>& box : boxes) {
    box.low[kLong] *= 8;
    box.high[kLong] *= 8;
  }
  const pnpbs::BoxTree<Dim> tree(boxes);
  for (const std::size_t many : {1, 8, 64}) {
    const std::vector<Box<Dim>> cover = tree.cover(many);
    ck_assert_uint_le(cover.size(), many + 1);
    for (const Box<Dim>& box : boxes)
      quick_assert(std::any_of(cover.begin(), cover.end(), [&](const Box<Dim>& c) {
        return lies_in<Dim>(box.low, c) && lies_in<Dim>(box.high, c);
      }));
    // Boxes are cut along their longest side.
    for (const Box<Dim>& c : cover)
      quick_assert(c.high[kLong] - c.low[kLong] < (many == 1 ? 5 : 2));
  }
}

// ------------------------------------------------------------------ cells near those of a rank -

// Cells with a largest d of a quarter of their width. Some lie outside the domain.
template <int Dim>
pnpbs::PartitionCells<Dim> cells_of(const pnpbs::BackgroundTree<Dim>& tree, Random& random) {
  std::vector<pnpbs::PartitionCell<Dim>> cells;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const auto& cell = tree.cell(tree.leaf_cell(leaf));
    const double d = tree.cell_side(tree.leaf_cell(leaf)) / 4;
    cells.push_back({cell.index, cell.depth, 1, random.below(6) == 0 ? 0 : d});
  }
  return {tree.cell_box(0), cells};
}

// Expects own cells, cells with an own bubble within their reach, and cells within the reach of an
// own bubble.
template <int Dim>
void expect_cells_near_own(const pnpbs::PartitionCells<Dim>& cells, int rank,
                           const std::vector<std::int32_t>& owner, int hops, double reach) {
  const auto box = [&](std::int32_t c) { return cells.tree().cell_box(cells.tree().leaf_cell(c)); };
  const auto way = [&](std::int32_t c) { return hops * (reach + 2) * cells.max_spacing(c); };
  const auto is_own = [&](std::int32_t c) { return owner[static_cast<std::size_t>(c)] == rank; };
  std::vector<char> expected;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    bool near = is_own(c);
    for (std::int32_t own = 0; own < cells.count() && !near; ++own)
      near = is_own(own) && cells.max_spacing(own) > 0 &&
             gap_between<Dim>(box(own), box(c)) <= std::max(way(own), way(c));
    expected.push_back(near);
  }
  const pnpbs::Distribution<Dim> distribution(cells, owner, rank, rank + 1);
  quick_assert(distribution.cells_near_own(hops, reach) == expected);
}

template <int Dim>
void expect_cells_near_ranks() {
  const pnpbs::BackgroundTree<Dim> tree = graded_tree<Dim>();
  Random random(82);
  const pnpbs::PartitionCells<Dim> cells = cells_of(tree, random);
  ck_assert_int_eq(cells.count(), tree.leaf_count());
  constexpr int kRanks = 7;
  std::vector<std::int32_t> in_rows, anywhere;  // contiguous, as a partition would be; and random
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    in_rows.push_back(kRanks * c / cells.count());
    anywhere.push_back(static_cast<std::int32_t>(random.below(kRanks)));
  }
  for (int rank = 0; rank <= kRanks; ++rank)  // the last has no cells
    for (const int hops : {1, 3})
      for (const std::vector<std::int32_t>& owner : {in_rows, anywhere})
        expect_cells_near_own<Dim>(cells, rank, owner, hops, 0.07);
}

}  // namespace

START_TEST(leaves_are_linked_as_by_search) {
  expect_leaf_graphs(graded_tree<2>());
  expect_leaf_graphs(graded_tree<3>());
  expect_leaf_graphs(uneven_tree<2>());
  expect_leaf_graphs(uneven_tree<3>());
}
END_TEST

START_TEST(hops_are_counted_as_by_search) {
  expect_hops(graded_tree<2>());
  expect_hops(uneven_tree<2>());
  expect_hops(uneven_tree<3>());
}
END_TEST

START_TEST(a_rank_stores_links_of_own_leaves_only) {
  expect_links_of_own_leaves<2>();
  expect_links_of_own_leaves<3>();
}
END_TEST

START_TEST(boxes_are_found_as_by_search) {
  expect_box_queries<2>();
  expect_box_queries<3>();
}
END_TEST

START_TEST(covers_hold_all_boxes) {
  expect_cover<2>();
  expect_cover<3>();
}
END_TEST

START_TEST(cells_are_found_around_a_rank_as_by_search) {
  expect_cells_near_ranks<2>();
  expect_cells_near_ranks<3>();
}
END_TEST

TEST_SUITE(test_trees) {
  return run_kernel_suite("trees",
                          {leaves_are_linked_as_by_search, hops_are_counted_as_by_search,
                           a_rank_stores_links_of_own_leaves_only, boxes_are_found_as_by_search,
                           covers_hold_all_boxes, cells_are_found_around_a_rank_as_by_search});
}
