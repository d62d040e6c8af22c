// SPDX-License-Identifier: BSD-3-Clause
// The cells that the partition deals out whole: disjoint cells of the background tree that cover
// it, some hundreds per rank, the same on every rank. Which ones they are depends on the number of
// ranks; no node does.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "domain/domain_map.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

struct PartitionCell {
  std::array<std::uint32_t, 2> index;  // among the cells of its depth
  std::int32_t depth;
  std::int64_t work;       // that its nodes cost
  double largest_spacing;  // of the samples of d in it
};

class PartitionCells {
 public:
  // One cell: the root, which has all the work.
  PartitionCells() : PartitionCells(Box<2>{}, {}) {}
  PartitionCells(const Box<2>& bounds, const std::vector<PartitionCell>& cells);

  std::int32_t count() const { return tree_.leaf_count(); }
  std::int32_t at(const Point<2>& x) const { return tree_.leaf_at(x); }
  std::int64_t work(std::int32_t c) const { return work_[static_cast<std::size_t>(c)]; }
  const std::vector<std::int64_t>& work() const { return work_; }
  double largest_spacing(std::int32_t c) const {
    return largest_spacing_[static_cast<std::size_t>(c)];
  }
  // The tree whose leaves they are.
  const BackgroundTree<2>& tree() const { return tree_; }

 private:
  BackgroundTree<2> tree_;
  std::vector<std::int64_t> work_;
  std::vector<double> largest_spacing_;
};

// Cells with equal shares of the work, as far as leaves allow. Each rank knows the leaves that it
// owns and their work, and puts together the largest cells of its own with no more than its share.
// Collective; of all ranks.
std::vector<PartitionCell> cells_of_equal_work(const Communicator& comm, const DomainMap& map,
                                               const std::function<bool(std::int32_t)>& owns,
                                               const std::vector<std::int64_t>& leaf_work);

}  // namespace pnpbs
