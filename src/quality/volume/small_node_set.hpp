// SPDX-License-Identifier: BSD-3-Clause
// A few nodes, such as those around one, of which it is often asked whether a node is among them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pnpbs {

class SmallNodeSet {
 public:
  void add(std::int32_t node) {
    if (count_ == padded_.size()) padded_.resize(count_ + kLanes, kNone);
    padded_[count_++] = node;
  }
  // Without a branch for each of them, which would be mispredicted as often as not.
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
  // In the order in which they were added.
  std::span<const std::int32_t> all() const { return {padded_.data(), count_}; }

 private:
  static constexpr std::size_t kLanes = 16;
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> padded_;  // to full lanes, by kNone
  std::size_t count_ = 0;
};

}  // namespace pnpbs
