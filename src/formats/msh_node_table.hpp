// SPDX-License-Identifier: BSD-3-Clause
// Lookup of the nodes of a mesh by their tags in the file.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace pnpbs {

// A map from node tags to indices. Consecutive tags need no memory.
class MshNodeTable {
 public:
  void build(const std::vector<std::int64_t>& tags) {
    first_ = tags.empty() ? 0 : tags.front();
    count_ = static_cast<std::int64_t>(tags.size());
    consecutive_ = true;
    for (std::size_t i = 0; i < tags.size() && consecutive_; ++i)
      consecutive_ = tags[i] == first_ + static_cast<std::int64_t>(i);
    if (consecutive_) return;
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (!numbers_.try_emplace(tags[i], static_cast<std::int32_t>(i)).second) repeated_ = tags[i];
  }
  std::optional<std::int64_t> repeated() const { return repeated_; }

  // Returns the index of the node, or -1 if none exists.
  std::int32_t at(std::int64_t tag) const {
    if (consecutive_)
      return tag >= first_ && tag - first_ < count_ ? static_cast<std::int32_t>(tag - first_) : -1;
    const auto found = numbers_.find(tag);
    return found == numbers_.end() ? -1 : found->second;
  }

 private:
  bool consecutive_ = true;
  std::int64_t first_ = 0, count_ = 0;
  std::unordered_map<std::int64_t, std::int32_t> numbers_;
  std::optional<std::int64_t> repeated_;
};

}  // namespace pnpbs
