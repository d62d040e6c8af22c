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
#include <optional>
#include <vector>

#include "base/periodic_cell.hpp"
#include "base/rank_limit.hpp"
#include "base/types.hpp"

namespace pnpbs {

// What a tree covers: a box and, if it is that of a periodic domain with images of it around it,
// the cell of the domain.
template <int Dim>
struct TreeBounds {
  TreeBounds(const Box<Dim>& covered) : box(covered) {}  // NOLINT: implicit conversion
  TreeBounds(const Box<Dim>& covered, const PeriodicCell<Dim>& of) : box(covered), cell(of) {}
  Box<Dim> box;
  PeriodicCell<Dim> cell;
};

// A quadtree or octree whose leaves are numbered in Morton order. If the domain is periodic, its
// periods are sides of cells of the tree, so that the tree repeats like the domain.
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
  // of the box lies strictly inside. If the domain is periodic, the root may be up to twice as long
  // along one axis as along another.
  void build(
      const TreeBounds<Dim>& bounds, const Splitter& splitter,
      const GoOn& go_on = [](bool more) { return more; }) {
    const Box<Dim>& box = bounds.box;
    side_ = 0;
    for (int k = 0; k < Dim; ++k) side_ = std::max(side_, box.high[k] - box.low[k]);
    for (int k = 0; k < Dim; ++k) origin_[k] = box.low[k] - side_ / 2048;
    side_ += side_ / 1024;
    cell_ = bounds.cell;
    if (cell_.any()) cover_images(box);
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
  // Return the longest side of the root and of a cell.
  double side() const { return side_; }
  double cell_side(std::int32_t c) const { return sides_[static_cast<std::size_t>(cell(c).depth)]; }
  // Returns the area (volume) of the root in units of that of a square (cube) of its longest side.
  double aspect() const { return aspect_; }
  // Returns the area (volume) of a cell.
  double cell_measure(std::int32_t c) const {
    double measure = aspect_;
    for (int k = 0; k < Dim; ++k) measure *= cell_side(c);
    return measure;
  }
  const PeriodicCell<Dim>& periodic_cell() const { return cell_; }
  // Returns the smallest depth at which no cell meets several copies of the periodic cell.
  int depth_of_periods() const { return *std::ranges::max_element(period_depth_); }
  // Returns the copy of the periodic cell that contains a cell of the tree of at least this depth.
  Image<Dim> image_of(const Cell& of) const {
    Image<Dim> image{};
    for (int k = 0; k < Dim; ++k)
      if (cell_.periodic(k))
        image[k] = static_cast<std::int32_t>(of.index[k] >> (of.depth - period_depth_[k])) -
                   periods_below_[k];
    return image;
  }
  // Returns whether a cell of the tree does not lie in the domain's periodic cell. False for all
  // cells if the domain is not periodic.
  bool is_image(std::int32_t c) const {
    return cell_.any() && (cell(c).depth < depth_of_periods() || image_of(cell(c)) != Image<Dim>{});
  }
  bool in_periodic_cell(std::int32_t leaf) const { return !is_image(leaf_cell(leaf)); }
  // Returns the index of the cell of the same depth that is the image of a cell, or nothing if the
  // tree does not extend as far.
  std::optional<std::array<std::uint32_t, Dim>> moved_index(const Cell& from,
                                                            const Image<Dim>& by) const {
    std::array<std::uint32_t, Dim> index = from.index;
    for (int k = 0; k < Dim; ++k) {
      if (!cell_.periodic(k)) continue;
      const std::int64_t to =
          from.index[k] +
          std::int64_t{by[k]} * (std::int64_t{1} << (from.depth - period_depth_[k]));
      if (to < 0 || to >= std::int64_t{1} << from.depth) return std::nullopt;
      index[k] = static_cast<std::uint32_t>(to);
    }
    return index;
  }

  // Calls visit(image) for each copy of the periodic cell that the root covers.
  template <class Visit>
  void for_images(const Visit& visit) const {
    std::array<std::int32_t, 3> low{}, high{};
    for (std::size_t k = 0; k < Dim; ++k) {
      if (!cell_.periodic(static_cast<int>(k))) continue;
      low[k] = -periods_below_[k];
      high[k] = low[k] + (std::int32_t{1} << period_depth_[k]) - 1;
    }
    for (std::int32_t z = low[2]; z <= high[2]; ++z)
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
        for (std::int32_t x = low[0]; x <= high[0]; ++x)
          if constexpr (Dim == 2)
            visit(Image<2>{x, y});
          else
            visit(Image<3>{x, y, z});
  }

  // Returns the box of a cell.
  Box<Dim> cell_box(std::int32_t c) const { return box_of(cell(c).index, cell(c).depth); }
  Box<Dim> box_of(const std::array<std::uint32_t, Dim>& index, std::int32_t depth) const {
    Box<Dim> box;
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = coordinate(k, index[k], depth);
      box.high[k] = coordinate(k, index[k] + std::int64_t{1}, depth);
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
    if (cell_.any()) {
      const Box<Dim> box = cell_box(c);
      return middle_of<Dim>(box.low, box.high);
    }
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
      const double t = fine_coordinate(k, x[k]);
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
      const double t = fine_coordinate(k, x[k]);
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
  // Makes the root so large that it covers the box and that each period is the side of a cell.
  void cover_images(const Box<Dim>& box) {
    Point<Dim> sides;
    sides.fill(0);
    const auto cells = [&](int k) { return std::int32_t{1} << period_depth_[k]; };
    for (int k = 0; k < Dim; ++k) {
      if (!cell_.periodic(k)) continue;
      const auto periods = [&](double length) {
        return static_cast<std::int32_t>(std::ceil(std::max(0.0, length) / cell_.period(k)));
      };
      periods_below_[k] = periods(cell_.box().low[k] - box.low[k]);
      const std::int32_t all = periods_below_[k] + 1 + periods(box.high[k] - cell_.box().high[k]);
      while (cells(k) < all) ++period_depth_[k];
      sides[k] = cells(k) * cell_.period(k);
    }
    side_ = *std::ranges::max_element(sides);
    for (int k = 0; k < Dim; ++k)
      if (!cell_.periodic(k)) side_ = std::max(side_, (box.high[k] - box.low[k]) * (1 + 0x1p-10));
    aspect_ = 1;
    for (int k = 0; k < Dim; ++k) {
      if (!cell_.periodic(k)) {
        origin_[k] = box.low[k] - side_ / 2048;
        continue;
      }
      while (2 * sides[k] <= side_) {
        ++period_depth_[k];
        sides[k] *= 2;
      }
      stretch_[k] = sides[k] / side_;
      aspect_ *= stretch_[k];
      origin_[k] = cell_.box().low[k] - periods_below_[k] * cell_.period(k);
    }
  }

  // Returns the coordinate of the lower side of the cells with this index. In a periodic domain the
  // coordinates of images differ exactly by the periods.
  double coordinate(int k, std::int64_t index, int depth) const {
    const double side = sides_[static_cast<std::size_t>(depth)];
    if (!cell_.periodic(k)) return origin_[k] + side * static_cast<double>(index);
    const double of_axis = side * stretch_[k];
    const int below = depth - period_depth_[k];  // depth below that of the periods
    if (below <= 0) return origin_[k] + of_axis * static_cast<double>(index);
    const std::int64_t periods = index >> below, rest = index - (periods << below);
    return origin_[k] + cell_.period(k) * static_cast<double>(periods) +
           cell_.rounded(of_axis * static_cast<double>(rest));
  }

  // Returns a coordinate in units of the cells of the largest depth. In a periodic domain those of
  // images differ exactly by whole periods.
  double fine_coordinate(int k, double x) const {
    if (!cell_.periodic(k)) return (x - origin_[k]) * scale_;
    const double cells = static_cast<double>(std::uint32_t{1} << (kMaxDepth - period_depth_[k]));
    double images = periods_below_[k];
    const double low = cell_.box().low[k], high = cell_.box().high[k];
    const std::int32_t all = std::int32_t{1} << period_depth_[k];
    for (; x < low && images >= 0; x += cell_.period(k)) --images;
    for (; x >= high && images < all; x -= cell_.period(k)) ++images;
    const double within = (x - low) * (cells / cell_.period(k));
    return images * cells + std::clamp(within, 0.0, std::nextafter(cells, 0.0));
  }

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
  double aspect_ = 1;
  double scale_ = kCells;                      // cells of the largest depth per unit of length
  std::array<double, kMaxDepth + 1> sides_{};  // side of the cells, by depth
  std::vector<Cell> cells_;
  std::vector<std::int32_t> leaves_;

  // Of a periodic domain: its cell, the depth at which cells are as long as a period, the shape of
  // the root, and the number of its periods below the cell.
  PeriodicCell<Dim> cell_;
  std::array<int, Dim> period_depth_{};
  Point<Dim> stretch_{};  // sides of the root in units of the longest one
  std::array<std::int32_t, Dim> periods_below_{};
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
