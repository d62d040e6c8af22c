// SPDX-License-Identifier: BSD-3-Clause
// The graph of leaves, the tree of boxes and the cells near a rank, in 2 and 3 dimensions, against
// all pairs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "bubbles.hpp"
#include "partition/distribution.hpp"
#include "run_kernel_suite.hpp"
#include "tree/box_tree.hpp"

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

// Expects that leaves are linked if one reaches the other, and each to itself.
template <int Dim>
void expect_links(const pnpbs::BackgroundTree<Dim>& tree, const std::vector<double>& reach) {
  pnpbs::LeafGraph<Dim> graph;
  graph.build(tree, reach);
  std::size_t links = 0;
  for (std::int32_t a = 0; a < tree.leaf_count(); ++a) {
    Indices expected, found;
    const Box<Dim> box = tree.cell_box(tree.leaf_cell(a));
    for (std::int32_t b = 0; b < tree.leaf_count(); ++b) {
      const double farther =
          std::max(reach[static_cast<std::size_t>(a)], reach[static_cast<std::size_t>(b)]);
      const double gap = gap_between<Dim>(box, tree.cell_box(tree.leaf_cell(b)));
      if (a == b || (farther > 0 && gap <= farther)) expected.push_back(b);
    }
    graph.for_neighbours(a, [&](std::int32_t b) { found.push_back(b); });
    quick_assert(found == expected);
    links += found.size();
  }
  ck_assert_uint_gt(links, 2 * static_cast<std::size_t>(tree.leaf_count()));
}

template <int Dim>
void expect_leaf_graphs() {
  const pnpbs::BackgroundTree<Dim> tree = graded_tree<Dim>();
  ck_assert_int_gt(tree.leaf_count(), 100);
  Random random(81);
  const auto leaves = static_cast<std::size_t>(tree.leaf_count());
  // Reaches: the width of each leaf; random, some of them zero; and so small that only touching
  // leaves are linked.
  std::vector<double> widths(leaves), any(leaves), touching(leaves, 1e-9);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    widths[leaf] = 1.01 * tree.cell_side(tree.leaf_cell(static_cast<std::int32_t>(leaf)));
    any[leaf] = random.below(4) == 0 ? 0 : std::pow(10, random.between(-3, -0.5));
  }
  for (const auto& reach : {widths, any, touching}) expect_links<Dim>(tree, reach);
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
  quick_assert(pnpbs::Distribution<Dim>(cells, owner, rank).cells_near_own(hops, reach) ==
               expected);
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
  expect_leaf_graphs<2>();
  expect_leaf_graphs<3>();
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
  return run_kernel_suite(
      "trees", {leaves_are_linked_as_by_search, boxes_are_found_as_by_search, covers_hold_all_boxes,
                cells_are_found_around_a_rank_as_by_search});
}
