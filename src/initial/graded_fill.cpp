// SPDX-License-Identifier: BSD-3-Clause
#include "initial/graded_fill.hpp"

#include "base/fixed_point.hpp"
#include "base/lattice.hpp"
#include "initial/initial_fill.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Number of cells across a leaf. Leaves are at most 4 d wide, and at least 2 d where d allows this,
// so cells are d/2 to d wide.
constexpr int kCellsAcross = 4;
template <int Dim>
constexpr int kCellsPerLeaf = 1 << (2 * Dim);

// Returns the coordinate along axis k of a cell, from its index in Morton order.
template <int Dim>
int column_of(int place, int k) {
  return ((place >> k) & 1) | (((place >> (k + Dim)) & 1) << 1);
}

// Returns true if d varies too much in the leaf for a lattice of constant spacing.
template <int Dim>
bool is_steep(const SizedTree<Dim>& map, std::int32_t leaf) {
  return !map.leaf_outside(leaf) &&
         map.leaf_max_spacing(leaf) > method::kPatchVariation * map.leaf_min_spacing(leaf);
}

// Returns the number of nodes that d requires in a cell. [2^-32]
template <int Dim>
std::int64_t wanted_in_cell(double side, double d) {
  double wanted = Lattice<Dim>::kDensity;
  for (int k = 0; k < Dim; ++k) wanted *= side / d;
  return fixed_point(wanted);
}

// Returns node n of `count` in a cell. Nodes are evenly spaced on its diagonal; a single one is at
// the centre.
template <int Dim>
Point<Dim> on_diagonal(double side, const Point<Dim>& centre, int n, int count) {
  const double off = side * ((n + 0.5) / count - 0.5);
  Point<Dim> x = centre;
  for (double& along : x) along += off;
  return x;
}

}  // namespace

template <int Dim>
GradedFill<Dim>::GradedFill(const SizedTree<Dim>& map,
                            const std::function<bool(std::int32_t)>& wanted)
    : map_(map) {
  const BackgroundTree<Dim>& tree = map.tree();
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!is_steep(map, leaf) || !wanted(leaf)) continue;
    const Box<Dim> box = tree.cell_box(tree.leaf_cell(leaf));
    const bool stretched = tree.aspect() != 1;
    const double side = (stretched ? root<Dim>(tree.cell_measure(tree.leaf_cell(leaf)))
                                   : tree.cell_side(tree.leaf_cell(leaf))) /
                        kCellsAcross;
    leaves_.push_back({leaf, side, centres_.size(), centres_.size()});
    for (int place = 0; place < kCellsPerLeaf<Dim>; ++place) {
      Point<Dim> x;
      for (int k = 0; k < Dim; ++k) {
        const double along = stretched ? (box.high[k] - box.low[k]) / kCellsAcross : side;
        x[k] = box.low[k] + along * (column_of<Dim>(place, k) + 0.5);
      }
      if (map.inside_in_leaf(leaf, x)) centres_.push_back(x);
    }
    leaves_.back().end = centres_.size();
  }
}

template <int Dim>
std::vector<std::int64_t> GradedFill<Dim>::wanted_nodes(const std::vector<double>& d) const {
  std::vector<std::int64_t> wanted(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  for (const Leaf& leaf : leaves_)
    for (std::size_t cell = leaf.first; cell < leaf.end; ++cell)
      wanted[static_cast<std::size_t>(leaf.leaf)] += wanted_in_cell<Dim>(leaf.cell_side, d[cell]);
  return wanted;
}

template <int Dim>
std::vector<Point<Dim>> GradedFill<Dim>::place(const std::vector<double>& d,
                                               const std::vector<std::int64_t>& before) const {
  constexpr std::int64_t kOne = kFixedPointOne, kHalf = kOne / 2;
  std::vector<Point<Dim>> nodes;
  for (const Leaf& leaf : leaves_) {
    std::int64_t sum = fraction_of(before[static_cast<std::size_t>(leaf.leaf)]) + kHalf;
    for (std::size_t cell = leaf.first; cell < leaf.end; ++cell) {
      const std::int64_t whole = sum / kOne;
      sum += wanted_in_cell<Dim>(leaf.cell_side, d[cell]);
      const auto count = static_cast<int>(sum / kOne - whole);
      const double clearance = method::kFillClearance * d[cell];
      for (int n = 0; n < count; ++n) {
        const Point<Dim> x = on_diagonal<Dim>(leaf.cell_side, centres_[cell], n, count);
        if (map_.inside_in_leaf(leaf.leaf, x) && map_.clearance(x, clearance) >= clearance)
          nodes.push_back(x);
      }
    }
  }
  return nodes;
}

template class GradedFill<2>;
template class GradedFill<3>;

}  // namespace pnpbs
