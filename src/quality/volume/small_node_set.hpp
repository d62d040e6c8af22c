// SPDX-License-Identifier: BSD-3-Clause
// A small set of nodes with a fast membership test, such as the neighbours of a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pnpbs {

// An unordered set of local node indices in an array that is searched linearly.
class SmallNodeSet {
 public:
  // Appends a node, which must not be in the set yet.
  void add(std::int32_t node) {
    if (count_ == padded_.size()) padded_.resize(count_ + kLanes, kNone);
    padded_[count_++] = node;
  }
  // Returns whether the node is in the set. Compares a block of nodes without branches, since these
  // would often be mispredicted.
  bool contains(std::int32_t node) const {
    for (std::size_t first = 0; first < padded_.size(); first += kLanes) {
      const std::int32_t* const some = padded_.data() + first;
      std::int32_t found = 0;
#pragma omp simd reduction(| : found)
      for (std::size_t k = 0; k < kLanes; ++k) found |= some[k] == node ? 1 : 0;
      if (found != 0) return true;
    }
    return false;
  }
  // Returns the nodes in the order of insertion.
  std::span<const std::int32_t> all() const { return {padded_.data(), count_}; }

 private:
  static constexpr std::size_t kLanes = 16;
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> padded_;  // padded with kNone to full blocks
  std::size_t count_ = 0;
};

}  // namespace pnpbs
