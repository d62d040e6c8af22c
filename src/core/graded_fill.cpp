// SPDX-License-Identifier: BSD-3-Clause
#include "core/graded_fill.hpp"

#include "core/execution.hpp"
#include "core/initial_fill.hpp"

namespace pnpbs {

namespace {

// A leaf is at most four d wide, and at least two where d allows: then cells are half to one d.
constexpr int kCellsAcross = 4;
constexpr int kCellsPerLeaf = kCellsAcross * kCellsAcross;

// Every second bit of the place in Morton order, from bit k on: the cell's column or row.
int column_of(int place, int k) { return ((place >> k) & 1) | ((place >> (k + 1)) & 2); }

}  // namespace

bool leaf_is_steep(const DomainMap& map, std::int32_t leaf) {
  constexpr double kSteep = 1.08;
  return !map.leaf_outside(leaf) &&
         map.leaf_largest_spacing(leaf) > kSteep * map.leaf_least_spacing(leaf);
}

GradedFill::GradedFill(const DomainMap& map, const std::function<bool(std::int32_t)>& wanted)
    : map_(map) {
  const BackgroundTree<2>& tree = map.tree();
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!leaf_is_steep(map, leaf) || !wanted(leaf)) continue;
    leaves_.push_back({leaf, centres_.size()});
    const Box<2> box = tree.cell_box(tree.leaf_cell(leaf));
    const double side = tree.cell_side(tree.leaf_cell(leaf)) / kCellsAcross;
    for (int place = 0; place < kCellsPerLeaf; ++place) {
      const Point<2> x{box.low[0] + side * (column_of(place, 0) + 0.5),
                       box.low[1] + side * (column_of(place, 1) + 0.5)};
      if (map.inside_in_leaf(leaf, x)) centres_.push_back(x);
    }
  }
}

std::int64_t GradedFill::wanted_in_cell(const Leaf& leaf, double d) const {
  const BackgroundTree<2>& tree = map_.tree();
  const double side = tree.cell_side(tree.leaf_cell(leaf.leaf)) / kCellsAcross;
  return fixed_point(kHexagonalDensity * (side / d) * (side / d));
}

// The n-th of `count` places in a cell: its centre, or along its diagonal.
Point<2> GradedFill::on_diagonal(const Leaf& leaf, const Point<2>& centre, int n, int count) const {
  const BackgroundTree<2>& tree = map_.tree();
  const double side = tree.cell_side(tree.leaf_cell(leaf.leaf)) / kCellsAcross;
  const double off = side * ((n + 0.5) / count - 0.5);
  return {centre[0] + off, centre[1] + off};
}

std::vector<std::int64_t> GradedFill::wanted_nodes(const std::vector<double>& d) const {
  std::vector<std::int64_t> wanted(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const std::size_t last = k + 1 < leaves_.size() ? leaves_[k + 1].first : centres_.size();
    for (std::size_t cell = leaves_[k].first; cell < last; ++cell)
      wanted[static_cast<std::size_t>(leaves_[k].leaf)] += wanted_in_cell(leaves_[k], d[cell]);
  }
  return wanted;
}

std::vector<Point<2>> GradedFill::place(const std::vector<double>& d,
                                        const std::vector<std::int64_t>& before) const {
  constexpr std::int64_t kOne = std::int64_t{1} << 32, kHalf = kOne / 2;
  std::vector<Point<2>> nodes;
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const std::size_t last = k + 1 < leaves_.size() ? leaves_[k + 1].first : centres_.size();
    std::int64_t sum = before[static_cast<std::size_t>(leaves_[k].leaf)] + kHalf;
    for (std::size_t cell = leaves_[k].first; cell < last; ++cell) {
      const std::int64_t whole = sum / kOne;
      sum += wanted_in_cell(leaves_[k], d[cell]);
      const auto count = static_cast<int>(sum / kOne - whole);
      const double clearance = kFillClearance * d[cell];
      for (int n = 0; n < count; ++n) {
        const Point<2> x = on_diagonal(leaves_[k], centres_[cell], n, count);
        if (map_.inside_in_leaf(leaves_[k].leaf, x) && map_.clearance(x, clearance) >= clearance)
          nodes.push_back(x);
      }
    }
  }
  return nodes;
}

}  // namespace pnpbs
