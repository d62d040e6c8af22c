// SPDX-License-Identifier: BSD-3-Clause
// Counts and bounding boxes of nodes, facets or elements by tag.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "comm/records.hpp"
#include "io/node_source.hpp"

namespace pnpbs::io {

// The groups of a rank by tag, and their sum over all ranks.
class TagGroups {
 public:
  void add(std::int32_t tag, std::span<const Point<3>> corners) {
    TagGroup& group = at(tag);
    ++group.count;
    for (const Point<3>& x : corners)
      for (std::size_t k = 0; k < 3; ++k) {
        // The sum is never -0, which would make the text depend on the order of nodes.
        group.low[k] = std::min(group.low[k], x[k] + 0.0);
        group.high[k] = std::max(group.high[k], x[k] + 0.0);
      }
  }

  // Returns the groups of all ranks, sorted by tag. Collective.
  std::vector<TagGroup> of_all(const Communicator& comm) const {
    Bytes mine;
    for (const auto& [tag, group] : groups_) pack(mine, group);
    TagGroups all;
    for_records<TagGroup>(comm.allgather(mine), [&](const TagGroup& group) { all.join(group); });
    std::vector<TagGroup> list;
    for (const auto& [tag, group] : all.groups_) list.push_back(group);
    return list;
  }

 private:
  TagGroup& at(std::int32_t tag) {
    return groups_.try_emplace(tag, TagGroup{tag, 0, filled(HUGE_VAL), filled(-HUGE_VAL)})
        .first->second;
  }
  static std::array<double, 3> filled(double value) { return {value, value, value}; }

  void join(const TagGroup& other) {
    TagGroup& group = at(other.tag);
    group.count += other.count;
    for (std::size_t k = 0; k < 3; ++k) {
      group.low[k] = std::min(group.low[k], other.low[k]);
      group.high[k] = std::max(group.high[k], other.high[k]);
    }
  }

  std::map<std::int32_t, TagGroup> groups_;
};

}  // namespace pnpbs::io
