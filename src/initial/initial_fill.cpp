// SPDX-License-Identifier: BSD-3-Clause
#include "initial/initial_fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pnpbs {

namespace {

struct Lattice {
  double step;  // between nodes of a row
  double row;   // between rows
};

bool nearly_constant(const SpacingSummary& cell) { return cell.max <= kPatchVariation * cell.min; }

SpacingSummary summary_of_leaf(const DomainMap<2>& map, std::int32_t c) {
  const std::int32_t leaf = map.tree().cell(c).leaf;
  SpacingSummary own;
  if (map.leaf_outside(leaf)) return own;
  const double d = map.leaf_spacing(leaf);
  own.area = map.tree().cell_side(c) * map.tree().cell_side(c);
  own.min = map.leaf_min_spacing(leaf);
  own.max = map.leaf_max_spacing(leaf);
  own.nodes = own.area / (d * d);
  return own;
}

class Fill {
 public:
  Fill(const DomainMap<2>& map, const Box<2>& bounds,
       const std::function<bool(std::int32_t)>& wanted, const std::vector<LeafSummary>& unrefined)
      : map_(map), bounds_(bounds), wanted_(wanted), cells_(spacing_summaries(map, unrefined)) {}

  std::vector<Point<2>> make() {
    const SpacingSummary& root = cells_[0];
    if (root.area > 0) descend(0, nullptr);
    return std::move(points_);
  }

 private:
  // Children in Morton order; `patch` is the lattice of the patch we are in, if any.
  void descend(std::int32_t c, const Lattice* patch) {
    const BackgroundTree<2>& tree = map_.tree();
    const SpacingSummary& own = cells_[static_cast<std::size_t>(c)];
    if (own.area == 0) return;
    const bool leaf = tree.cell(c).first_child < 0;
    Lattice lattice;
    if (!patch && nearly_constant(own)) {
      lattice = lattice_of(own.spacing(), c == 0);
      patch = &lattice;
    }
    if (leaf) {
      const std::int32_t here = tree.cell(c).leaf;
      if (patch && wanted_(here)) fill_leaf(here, *patch);  // others are graded_fill's
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

  // Whose a node on the border of two leaves is, leaf_holds alone decides: by the arithmetic of
  // leaf_at, which numbers the nodes and gives them their ranks. The box differs in last digits.
  void fill_leaf(std::int32_t leaf, const Lattice& lattice) {
    const BackgroundTree<2>& tree = map_.tree();
    const Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
    const double d = map_.leaf_spacing(leaf);
    const auto first_row =
        static_cast<std::int64_t>(std::ceil((box.low[1] - bounds_.low[1]) / lattice.row)) - 1;
    for (std::int64_t row = first_row;; ++row) {
      const double y = bounds_.low[1] + lattice.row * static_cast<double>(row);
      if (y >= box.high[1] + 0.5 * lattice.row) break;
      const double shift = bounds_.low[0] + (row % 2 != 0 ? 0.5 * lattice.step : 0.0);
      auto column = static_cast<std::int64_t>(std::ceil((box.low[0] - shift) / lattice.step)) - 1;
      for (;; ++column) {
        const Point<2> x{shift + lattice.step * static_cast<double>(column), y};
        if (x[0] >= box.high[0] + 0.5 * lattice.step) break;
        if (!tree.leaf_holds(leaf, x)) continue;
        if (!map_.inside_in_leaf(leaf, x)) continue;
        if (map_.clearance(x, kFillClearance * d) < kFillClearance * d) continue;
        points_.push_back(x);
      }
    }
  }

  const DomainMap<2>& map_;
  const Box<2>& bounds_;
  const std::function<bool(std::int32_t)>& wanted_;
  std::vector<SpacingSummary> cells_;
  std::vector<Point<2>> points_;
};

}  // namespace

void SpacingSummary::add(const SpacingSummary& part) {
  min = std::min(min, part.min);
  max = std::max(max, part.max);
  area += part.area;
  nodes += part.nodes;
}

std::vector<SpacingSummary> spacing_summaries(const DomainMap<2>& map,
                                              const std::vector<LeafSummary>& unrefined) {
  const BackgroundTree<2>& tree = map.tree();
  std::vector<SpacingSummary> cells(static_cast<std::size_t>(tree.cell_count()));
  const auto of = [&](std::int32_t c) -> SpacingSummary& {
    return cells[static_cast<std::size_t>(c)];
  };
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    of(tree.leaf_cell(leaf)) = summary_of_leaf(map, tree.leaf_cell(leaf));
  for (const LeafSummary& known : unrefined) of(tree.leaf_cell(known.leaf)) = known.spacing;
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c)
    if (tree.cell(c).first_child >= 0)
      for (int k = 0; k < BackgroundTree<2>::kChildren; ++k)
        of(c).add(of(tree.cell(c).first_child + k));
  return cells;
}

std::vector<Point<2>> hexagonal_fill(const DomainMap<2>& map, const Box<2>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted,
                                     const std::vector<LeafSummary>& unrefined) {
  return Fill(map, bounds, wanted, unrefined).make();
}

}  // namespace pnpbs
