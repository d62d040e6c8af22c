// SPDX-License-Identifier: BSD-3-Clause
// Partition cells: disjoint cells of the background tree that cover it and that the partition
// distributes as a whole. There are some hundreds per rank, the same ones on all ranks. The choice
// of cells depends on the number of ranks; the nodes do not.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
struct PartitionCell {
  std::array<std::uint32_t, Dim> index;  // index among the cells of its depth
  std::int32_t depth;
  std::int64_t work;   // cost of its nodes
  double max_spacing;  // largest sample of d in the cell; 0: outside the domain
  // Cost of a phase that has little to do at most nodes, and which the partition balances as well;
  // 0 in all cells if there is no such phase.
  std::int64_t rare_work = 0;
};

// The partition cells, as the leaves of a tree of their own.
template <int Dim>
class PartitionCells {
 public:
  // Creates a single cell, the root, which has all the work.
  PartitionCells() : PartitionCells(Box<Dim>{}, {}) {}
  // Creates the given cells. If the domain is periodic, these are the cells in its periodic cell,
  // and their images are created as well, without work.
  PartitionCells(const TreeBounds<Dim>& bounds, const std::vector<PartitionCell<Dim>>& cells);

  std::int32_t count() const { return tree_.leaf_count(); }
  std::int32_t at(const Point<Dim>& x) const { return tree_.leaf_at(x); }
  std::int64_t work(std::int32_t c) const { return work_[static_cast<std::size_t>(c)]; }
  const std::vector<std::int64_t>& work() const { return work_; }
  const std::vector<std::int64_t>& rare_work() const { return rare_work_; }
  double max_spacing(std::int32_t c) const { return max_spacing_[static_cast<std::size_t>(c)]; }
  // Return the copy of the periodic cell that a cell lies in, which is the farthest one for cells
  // beyond all copies, and the cell that it is an image of.
  Image<Dim> image_of(std::int32_t c) const;
  std::int32_t origin_of(std::int32_t c) const {
    const PeriodicCell<Dim>& cell = tree_.periodic_cell();
    return cell.any() ? at(cell.in_cell(tree_.cell_centre(tree_.leaf_cell(c)))) : c;
  }
  // Tree with the partition cells as leaves.
  const BackgroundTree<Dim>& tree() const { return tree_; }

 private:
  static std::vector<PartitionCell<Dim>> with_images(const TreeBounds<Dim>& bounds,
                                                     std::vector<PartitionCell<Dim>> cells);

  BackgroundTree<Dim> tree_;
  std::vector<std::int64_t> work_, rare_work_;
  std::vector<double> max_spacing_;
};

// Properties of the leaves of a rank's tree.
struct LeafFunctions {
  std::function<bool(std::int32_t leaf)> owned;
  std::function<std::int64_t(std::int32_t leaf)> work;       // called for owned leaves only
  std::function<double(std::int32_t leaf)> max_spacing;      // 0: the leaf is outside the domain
  std::function<std::int64_t(std::int32_t leaf)> rare_work;  // called for owned leaves; null: 0
};

// Returns partition cells with about equal work. Each rank combines the leaves that it owns into
// the largest cells whose work is at most the target share. Returns the cells of all ranks.
// Collective.
template <int Dim>
std::vector<PartitionCell<Dim>> cells_of_equal_work(const Communicator& comm,
                                                    const BackgroundTree<Dim>& tree,
                                                    const LeafFunctions& leaves);

extern template class PartitionCells<2>;
extern template class PartitionCells<3>;

}  // namespace pnpbs
