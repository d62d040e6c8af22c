// SPDX-License-Identifier: BSD-3-Clause
#include "core/initial_fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pnpbs {

namespace {

// d may vary by this factor within a patch.
constexpr double kPatchVariation = 1.08;
// New nodes stay this many d away from the boundary.
constexpr double kFillClearance = 0.5;

struct Lattice {
  double step;  // between nodes of a row
  double row;   // between rows
};

struct CellSpacing {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0;
  double area = 0, nodes = 0;  // of the leaves in the domain; nodes in units of 1 per d^2

  void add(const CellSpacing& part) {
    least = std::min(least, part.least);
    largest = std::max(largest, part.largest);
    area += part.area;
    nodes += part.nodes;
  }
  bool nearly_constant() const { return largest <= kPatchVariation * least; }
  double spacing() const { return std::sqrt(area / nodes); }
};

// Range of d in every cell of the tree, from the leaves up.
std::vector<CellSpacing> cell_spacings(const DomainMap& map) {
  const BackgroundTree<2>& tree = map.tree();
  std::vector<CellSpacing> cells(static_cast<std::size_t>(tree.cell_count()));
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {
    CellSpacing& own = cells[static_cast<std::size_t>(c)];
    const std::int32_t leaf = tree.cell(c).leaf;
    if (leaf < 0) {
      for (int k = 0; k < 4; ++k)
        own.add(cells[static_cast<std::size_t>(tree.cell(c).first_child + k)]);
    } else if (!map.leaf_outside(leaf)) {
      const double d = map.leaf_spacing(leaf);
      own.area = tree.cell_side(c) * tree.cell_side(c);
      own.least = map.leaf_least_spacing(leaf);
      own.largest = map.leaf_largest_spacing(leaf);
      own.nodes = own.area / (d * d);
    }
  }
  return cells;
}

class Fill {
 public:
  Fill(const DomainMap& map, const Box<2>& bounds, const std::function<bool(std::int32_t)>& wanted)
      : map_(map), bounds_(bounds), wanted_(wanted), cells_(cell_spacings(map)) {}

  std::vector<Point<2>> make() {
    const CellSpacing& root = cells_[0];
    if (root.area > 0) descend(0, nullptr);
    return std::move(points_);
  }

 private:
  // Children in Morton order; `patch` is the lattice of the patch we are in, if any.
  void descend(std::int32_t c, const Lattice* patch) {
    const BackgroundTree<2>& tree = map_.tree();
    const CellSpacing& own = cells_[static_cast<std::size_t>(c)];
    if (own.area == 0) return;
    const bool leaf = tree.cell(c).first_child < 0;
    Lattice lattice;
    if (!patch && (leaf || own.nearly_constant())) {
      lattice = lattice_of(own.spacing(), c == 0);
      patch = &lattice;
    }
    if (leaf) {
      if (wanted_(tree.cell(c).leaf)) fill_leaf(tree.cell(c).leaf, *patch);
    } else {
      for (int k = 0; k < 4; ++k) descend(tree.cell(c).first_child + k, patch);
    }
  }

  // One lattice for the whole domain is stretched a little so that rows end on its box.
  Lattice lattice_of(double d, bool whole) const {
    Lattice lattice{d, d * std::sqrt(0.75)};
    if (!whole) return lattice;
    lattice.step = fitted(lattice.step, bounds_.high[0] - bounds_.low[0]);
    lattice.row = fitted(lattice.row, bounds_.high[1] - bounds_.low[1]);
    return lattice;
  }

  static double fitted(double step, double extent) {
    const double steps = std::round(extent / step);
    return steps >= 8 ? extent / steps : step;
  }

  void fill_leaf(std::int32_t leaf, const Lattice& lattice) {
    const BackgroundTree<2>& tree = map_.tree();
    const Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
    const double d = map_.leaf_spacing(leaf);
    const auto first_row =
        static_cast<std::int64_t>(std::ceil((box.low[1] - bounds_.low[1]) / lattice.row)) - 1;
    for (std::int64_t row = first_row;; ++row) {
      const double y = bounds_.low[1] + lattice.row * static_cast<double>(row);
      if (y >= box.high[1]) break;
      const double shift = bounds_.low[0] + (row % 2 != 0 ? 0.5 * lattice.step : 0.0);
      auto column = static_cast<std::int64_t>(std::ceil((box.low[0] - shift) / lattice.step)) - 1;
      for (;; ++column) {
        const Point<2> x{shift + lattice.step * static_cast<double>(column), y};
        if (x[0] >= box.high[0]) break;
        if (x[0] < box.low[0] || y < box.low[1]) continue;
        if (!map_.inside_in_leaf(leaf, x)) continue;
        if (map_.clearance(x, kFillClearance * d) < kFillClearance * d) continue;
        points_.push_back(x);
      }
    }
  }

  const DomainMap& map_;
  const Box<2>& bounds_;
  const std::function<bool(std::int32_t)>& wanted_;
  std::vector<CellSpacing> cells_;
  std::vector<Point<2>> points_;
};

}  // namespace

std::vector<Point<2>> hexagonal_fill(const DomainMap& map, const Box<2>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted) {
  return Fill(map, bounds, wanted).make();
}

}  // namespace pnpbs
