// SPDX-License-Identifier: BSD-3-Clause
// The index of a node from its id.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/nodes.hpp"

namespace pnpbs {

// Maps the ids of nodes to their indices. It uses a table if the ids are dense.
class IndexById {
 public:
  IndexById() = default;  // of no nodes
  template <int Dim>
  explicit IndexById(const Nodes<Dim>& nodes)
      : IndexById(nodes, [](std::int64_t) { return true; }) {}
  // Maps only the ids of the nodes i for which counts(i) holds.
  template <int Dim, class Counts>
  IndexById(const Nodes<Dim>& nodes, const Counts& counts) {
    std::int64_t end = 0, count = 0;
    for (std::int64_t i = 0; i < nodes.count; ++i) {
      if (!counts(i)) continue;
      end = std::max(end, nodes.id(i) + 1);
      ++count;
    }
    const bool dense = end <= 4 * count;
    if (dense)
      table_.assign(static_cast<std::size_t>(end), -1);
    else
      map_.reserve(static_cast<std::size_t>(count));
    for (std::int32_t i = 0; i < nodes.count; ++i) {
      if (!counts(i)) continue;
      if (dense)
        table_[static_cast<std::size_t>(nodes.id(i))] = i;
      else
        map_.emplace(nodes.id(i), i);
    }
  }
  // Returns -1 if there is no such node or it does not count.
  std::int32_t of(std::int64_t id) const {
    if (!table_.empty())
      return id >= 0 && id < std::ssize(table_) ? table_[static_cast<std::size_t>(id)] : -1;
    const auto found = map_.find(id);
    return found == map_.end() ? -1 : found->second;
  }

 private:
  std::vector<std::int32_t> table_;
  std::unordered_map<std::int64_t, std::int32_t> map_;
};

}  // namespace pnpbs
