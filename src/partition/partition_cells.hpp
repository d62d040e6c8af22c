// SPDX-License-Identifier: BSD-3-Clause
// The cells that the partition distributes whole: disjoint cells of the background tree that cover
// it, some hundreds per rank, the same on every rank. Which ones they are depends on the number of
// ranks; no node does.
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
  std::array<std::uint32_t, Dim> index;  // among the cells of its depth
  std::int32_t depth;
  std::int64_t work;   // that its nodes cost
  double max_spacing;  // of the samples of d in it
};

template <int Dim>
class PartitionCells {
 public:
  // One cell: the root, which has all the work.
  PartitionCells() : PartitionCells(Box<Dim>{}, {}) {}
  PartitionCells(const Box<Dim>& bounds, const std::vector<PartitionCell<Dim>>& cells);

  std::int32_t count() const { return tree_.leaf_count(); }
  std::int32_t at(const Point<Dim>& x) const { return tree_.leaf_at(x); }
  std::int64_t work(std::int32_t c) const { return work_[static_cast<std::size_t>(c)]; }
  const std::vector<std::int64_t>& work() const { return work_; }
  double max_spacing(std::int32_t c) const { return max_spacing_[static_cast<std::size_t>(c)]; }
  // The tree whose leaves they are.
  const BackgroundTree<Dim>& tree() const { return tree_; }

 private:
  BackgroundTree<Dim> tree_;
  std::vector<std::int64_t> work_;
  std::vector<double> max_spacing_;
};

// What a rank tells of the leaves of its tree.
struct LeafFunctions {
  std::function<bool(std::int32_t leaf)> owned;
  std::function<std::int64_t(std::int32_t leaf)> work;   // asked for own ones
  std::function<double(std::int32_t leaf)> max_spacing;  // 0: nothing of the domain is in it
};

// Cells with equal shares of the work, as far as leaves allow. Each rank knows the leaves that it
// owns and their work, and puts together the largest cells of its own with no more than its share.
// Collective; of all ranks.
template <int Dim>
std::vector<PartitionCell<Dim>> cells_of_equal_work(const Communicator& comm,
                                                    const BackgroundTree<Dim>& tree,
                                                    const LeafFunctions& leaves);

extern template class PartitionCells<2>;
extern template class PartitionCells<3>;

}  // namespace pnpbs
