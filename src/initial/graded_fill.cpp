// SPDX-License-Identifier: BSD-3-Clause
#include "initial/graded_fill.hpp"

#include "base/execution.hpp"
#include "base/lattice.hpp"
#include "initial/initial_fill.hpp"

namespace pnpbs {

namespace {

// A leaf is at most four d wide, and at least two where d allows: then cells are half to one d.
constexpr int kCellsAcross = 4;
constexpr int kCellsPerLeaf = kCellsAcross * kCellsAcross;

// Every second bit of the place in Morton order, from bit k on: the cell's column or row.
int column_of(int place, int k) { return ((place >> k) & 1) | ((place >> (k + 1)) & 2); }

// No lattice of one d fits such a leaf.
bool is_steep(const DomainMap<2>& map, std::int32_t leaf) {
  return !map.leaf_outside(leaf) &&
         map.leaf_max_spacing(leaf) > kPatchVariation * map.leaf_min_spacing(leaf);
}

// In units of 2^-32.
std::int64_t wanted_in_cell(double side, double d) {
  return fixed_point(Lattice<2>::kDensity * (side / d) * (side / d));
}

// The n-th of `count` places in a cell: its centre, or along its diagonal.
Point<2> on_diagonal(double side, const Point<2>& centre, int n, int count) {
  const double off = side * ((n + 0.5) / count - 0.5);
  return {centre[0] + off, centre[1] + off};
}

}  // namespace

GradedFill::GradedFill(const DomainMap<2>& map, const std::function<bool(std::int32_t)>& wanted)
    : map_(map) {
  const BackgroundTree<2>& tree = map.tree();
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!is_steep(map, leaf) || !wanted(leaf)) continue;
    const Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
    const double side = tree.cell_side(tree.leaf_cell(leaf)) / kCellsAcross;
    leaves_.push_back({leaf, side, centres_.size(), centres_.size()});
    for (int place = 0; place < kCellsPerLeaf; ++place) {
      const Point<2> x{box.low[0] + side * (column_of(place, 0) + 0.5),
                       box.low[1] + side * (column_of(place, 1) + 0.5)};
      if (map.inside_in_leaf(leaf, x)) centres_.push_back(x);
    }
    leaves_.back().end = centres_.size();
  }
}

std::vector<std::int64_t> GradedFill::wanted_nodes(const std::vector<double>& d) const {
  std::vector<std::int64_t> wanted(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  for (const Leaf& leaf : leaves_)
    for (std::size_t cell = leaf.first; cell < leaf.end; ++cell)
      wanted[static_cast<std::size_t>(leaf.leaf)] += wanted_in_cell(leaf.cell_side, d[cell]);
  return wanted;
}

std::vector<Point<2>> GradedFill::place(const std::vector<double>& d,
                                        const std::vector<std::int64_t>& before) const {
  constexpr std::int64_t kOne = std::int64_t{1} << 32, kHalf = kOne / 2;
  std::vector<Point<2>> nodes;
  for (const Leaf& leaf : leaves_) {
    std::int64_t sum = before[static_cast<std::size_t>(leaf.leaf)] + kHalf;
    for (std::size_t cell = leaf.first; cell < leaf.end; ++cell) {
      const std::int64_t whole = sum / kOne;
      sum += wanted_in_cell(leaf.cell_side, d[cell]);
      const auto count = static_cast<int>(sum / kOne - whole);
      const double clearance = kFillClearance * d[cell];
      for (int n = 0; n < count; ++n) {
        const Point<2> x = on_diagonal(leaf.cell_side, centres_[cell], n, count);
        if (map_.inside_in_leaf(leaf.leaf, x) && map_.clearance(x, clearance) >= clearance)
          nodes.push_back(x);
      }
    }
  }
  return nodes;
}

}  // namespace pnpbs
