// SPDX-License-Identifier: BSD-3-Clause
// The background tree: a quadtree (octree) over the bounding box of the domain. It depends only on
// the box, d and the boundary, so it is the same on every rank. Its leaves are the buckets of the
// nodes, d is sampled in its cells, and the partition distributes its cells.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/rank_limit.hpp"
#include "base/types.hpp"

namespace pnpbs {

// A quadtree or octree whose leaves are numbered in Morton order.
template <int Dim>
class BackgroundTree {
 public:
  static constexpr int kChildren = 1 << Dim;
  static constexpr int kMaxDepth = 30;

  struct Cell {
    std::array<std::uint32_t, Dim> index;  // integer coordinates among the cells of its depth
    std::int32_t depth;
    std::int32_t first_child;  // first of 2^Dim children, in Morton order; -1 for a leaf
    std::int32_t leaf;         // index among the leaves in Morton order; -1 for other cells
  };

  // Decides which cells are split. Called once for all cells of a depth; sets split[c - first] to 1
  // for each cell c in first .. last-1 that is to be split.
  using Splitter = std::function<void(const BackgroundTree& tree, std::int32_t first,
                                      std::int32_t last, std::vector<char>& split)>;
  // Decides whether the tree grows to the next depth; `more` is true if the tree has cells there.
  // If each rank refines its own part of the tree, this function is collective: all ranks continue
  // while one of them has cells, so that they sample d in step.
  using GoOn = std::function<bool(bool more)>;

  BackgroundTree() = default;

  // Builds the tree. The root is a square (cube) slightly larger than the box, so that every point
  // of the box lies strictly inside.
  void build(
      const Box<Dim>& box, const Splitter& splitter,
      const GoOn& go_on = [](bool more) { return more; }) {
    side_ = 0;
    for (int k = 0; k < Dim; ++k) side_ = std::max(side_, box.high[k] - box.low[k]);
    for (int k = 0; k < Dim; ++k) origin_[k] = box.low[k] - side_ / 2048;
    side_ += side_ / 1024;
    constexpr double kOperations = 8 * 0x1p-52;
    for (int k = 0; k < Dim; ++k) rounding_[k] = kOperations * (std::fabs(origin_[k]) + side_);
    scale_ = kCells / side_;
    for (int depth = 0; depth <= kMaxDepth; ++depth)
      sides_[static_cast<std::size_t>(depth)] = std::ldexp(side_, -depth);
    cells_.assign(1, Cell{{}, 0, -1, -1});
    std::int32_t first = 0;
    std::vector<char> split;
    for (int depth = 0; depth < kMaxDepth && go_on(first < cell_count()); ++depth) {
      const std::int32_t last = cell_count();
      split.assign(static_cast<std::size_t>(last - first), 0);
      splitter(*this, first, last, split);
      for (std::int32_t c = first; c < last; ++c)
        if (split[static_cast<std::size_t>(c - first)]) add_children(c);
      first = last;
    }
    number_leaves();
  }

  std::int32_t cell_count() const { return static_cast<std::int32_t>(cells_.size()); }
  std::int32_t leaf_count() const { return static_cast<std::int32_t>(leaves_.size()); }
  const Cell& cell(std::int32_t c) const { return cells_[static_cast<std::size_t>(c)]; }
  std::int32_t leaf_cell(std::int32_t leaf) const {
    return leaves_[static_cast<std::size_t>(leaf)];
  }
  const Point<Dim>& origin() const { return origin_; }
  double side() const { return side_; }
  double cell_side(std::int32_t c) const { return sides_[static_cast<std::size_t>(cell(c).depth)]; }

  // Returns the box of a cell.
  Box<Dim> cell_box(std::int32_t c) const {
    const double s = cell_side(c);
    Box<Dim> box;
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = origin_[k] + s * cell(c).index[k];
      box.high[k] = origin_[k] + s * (cell(c).index[k] + 1.0);
    }
    return box;
  }

  // Returns the box of a cell, enlarged by the rounding error of leaf_at, which may assign points
  // to a cell that lie just outside its box. The enlargement is not negligible for a small domain
  // far from the origin.
  Box<Dim> cell_box_with_room(std::int32_t c) const {
    Box<Dim> box = cell_box(c);
    for (int k = 0; k < Dim; ++k) {
      box.low[k] -= rounding_[k];
      box.high[k] += rounding_[k];
    }
    return box;
  }

  Point<Dim> cell_centre(std::int32_t c) const {
    const double s = cell_side(c);
    Point<Dim> centre;
    for (int k = 0; k < Dim; ++k) centre[k] = origin_[k] + s * (cell(c).index[k] + 0.5);
    return centre;
  }

  // Returns the leaf that contains x, or the nearest leaf at the border if x is outside the root.
  std::int32_t leaf_at(const Point<Dim>& x) const { return cell(cell_at(x, kMaxDepth)).leaf; }

  // Returns the same. Faster if `guess` is this leaf; -1 means no guess.
  std::int32_t leaf_at(const Point<Dim>& x, std::int32_t guess) const {
    return guess >= 0 && leaf_holds(guess, x) ? guess : leaf_at(x);
  }

  // Returns the cell at this depth that contains x, or the leaf that contains x if it is less deep.
  std::int32_t cell_at(const Point<Dim>& x, int depth) const {
    const std::array<std::uint32_t, Dim> fine = fine_index(x);
    std::int32_t c = 0;
    for (int shift = kMaxDepth - 1; shift >= kMaxDepth - depth && cell(c).first_child >= 0;
         --shift) {
      int child = 0;
      for (int k = 0; k < Dim; ++k) child |= static_cast<int>((fine[k] >> shift) & 1u) << k;
      c = cell(c).first_child + child;
    }
    return c;
  }

  // Returns the integer coordinates of x among the cells of the largest depth. A coordinate that is
  // NaN gives 0.
  std::array<std::uint32_t, Dim> fine_index(const Point<Dim>& x) const {
    std::array<std::uint32_t, Dim> fine;
    for (int k = 0; k < Dim; ++k) {
      const double t = (x[k] - origin_[k]) * scale_;
      fine[k] = !(t > 0) ? 0u : t >= kCells - 1 ? kLastIndex : static_cast<std::uint32_t>(t);
    }
    return fine;
  }

  // Returns the half-open box of a leaf in units of the cells of the largest depth. Used for many
  // tests on the same leaf.
  Box<Dim> fine_box(std::int32_t leaf) const {
    const Cell& c = cell(leaf_cell(leaf));
    const double cells = static_cast<double>(1u << (kMaxDepth - c.depth));
    Box<Dim> box;
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = cells * c.index[k];
      box.high[k] = cells * (c.index[k] + 1.0);
    }
    return box;
  }

  // Returns true if x lies in the leaf with this box. The test uses the same arithmetic as leaf_at.
  bool fine_box_holds(const Box<Dim>& box, const Point<Dim>& x) const {
    bool holds = true;
    for (int k = 0; k < Dim; ++k) {
      const double t = (x[k] - origin_[k]) * scale_;
      holds = holds && t >= box.low[k] && t < box.high[k];
    }
    return holds;
  }

  bool leaf_holds(std::int32_t leaf, const Point<Dim>& x) const {
    return fine_box_holds(fine_box(leaf), x);
  }

  // Calls visit(leaf) for all leaves whose closed box intersects the closed box `box`, in Morton
  // order.
  template <class Visit>
  void for_leaves_in(const Box<Dim>& box, const Visit& visit) const {
    for_leaves_in(
        box, [](std::int32_t) { return true; }, visit);
  }
  // The same, but skips each cell for which enter(cell) is false and all leaves in it.
  template <class Enter, class Visit>
  void for_leaves_in(const Box<Dim>& box, const Enter& enter, const Visit& visit) const {
    visit_cell(cell_around(box), box, enter, visit);
  }

  // Returns the smallest cell that contains the box with a margin. No cell outside it intersects
  // the box.
  std::int32_t cell_around(const Box<Dim>& box) const {
    const std::array<std::uint32_t, Dim> low = fine_index(box.low), high = fine_index(box.high);
    std::uint32_t differing = 0;
    for (int k = 0; k < Dim; ++k)
      differing |=
          (low[k] > 0 ? low[k] - 1 : 0) ^ (high[k] < kLastIndex ? high[k] + 1 : kLastIndex);
    return cell_at(box.low, kMaxDepth - static_cast<int>(std::bit_width(differing)));
  }

 private:
  void add_children(std::int32_t c) {
    require_fits_rank(std::ssize(cells_) + kChildren, "cells of the background tree");
    cells_[static_cast<std::size_t>(c)].first_child = cell_count();
    const Cell parent = cell(c);
    for (int child = 0; child < kChildren; ++child) {
      Cell next{{}, parent.depth + 1, -1, -1};
      for (int k = 0; k < Dim; ++k) next.index[k] = 2 * parent.index[k] + ((child >> k) & 1);
      cells_.push_back(next);
    }
  }

  void number_leaves() {
    leaves_.clear();
    std::vector<std::int32_t> stack{0};
    while (!stack.empty()) {
      const std::int32_t c = stack.back();
      stack.pop_back();
      if (cell(c).first_child < 0) {
        cells_[static_cast<std::size_t>(c)].leaf = leaf_count();
        leaves_.push_back(c);
      } else {
        for (int child = kChildren - 1; child >= 0; --child)
          stack.push_back(cell(c).first_child + child);
      }
    }
  }

  template <class Enter, class Visit>
  void visit_cell(std::int32_t c, const Box<Dim>& box, const Enter& enter,
                  const Visit& visit) const {
    if (!enter(c)) return;
    const Box<Dim> own = cell_box_with_room(c);
    for (int k = 0; k < Dim; ++k)
      if (own.high[k] < box.low[k] || own.low[k] > box.high[k]) return;
    if (cell(c).first_child < 0) {
      visit(cell(c).leaf);
      return;
    }
    for (int child = 0; child < kChildren; ++child)
      visit_cell(cell(c).first_child + child, box, enter, visit);
  }

  Point<Dim> origin_{};
  Point<Dim> rounding_{};                            // rounding error of leaf_at, by coordinate
  static constexpr double kCells = 1u << kMaxDepth;  // cells of the largest depth along a side
  static constexpr std::uint32_t kLastIndex = (1u << kMaxDepth) - 1u;

  double side_ = 1;
  double scale_ = kCells;                      // cells of the largest depth per unit of length
  std::array<double, kMaxDepth + 1> sides_{};  // side of the cells, by depth
  std::vector<Cell> cells_;
  std::vector<std::int32_t> leaves_;
};

// Returns for each cell of the tree the largest value of the leaves in it. T is not negative.
template <int Dim, class T>
std::vector<T> max_in_cells(const BackgroundTree<Dim>& tree, const std::vector<T>& of_leaves) {
  std::vector<T> max(static_cast<std::size_t>(tree.cell_count()), T{});
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {  // children come after their parent
    const typename BackgroundTree<Dim>::Cell& cell = tree.cell(c);
    T& value = max[static_cast<std::size_t>(c)];
    if (cell.first_child < 0) value = of_leaves[static_cast<std::size_t>(cell.leaf)];
    for (int k = 0; cell.first_child >= 0 && k < BackgroundTree<Dim>::kChildren; ++k)
      value = std::max(value, max[static_cast<std::size_t>(cell.first_child + k)]);
  }
  return max;
}

}  // namespace pnpbs
