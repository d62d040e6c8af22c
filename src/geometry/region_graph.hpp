// SPDX-License-Identifier: BSD-3-Clause
// The regions into which curves divide the plane, or surfaces space, and the contacts between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/index.hpp"

namespace pnpbs {

// Regions by number. Region 0 is the unbounded one.
class RegionGraph {
 public:
  // `contacts` are the two regions at each edge or triangle between regions.
  RegionGraph(std::size_t regions, std::vector<std::array<std::int32_t, 2>> contacts)
      : contacts_(std::move(contacts)), at_(regions) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const auto& [a, b] = contacts_[c];
      if (a == b) continue;
      at_[index(a)].push_back(c);
      at_[index(b)].push_back(c);
    }
  }

  // Returns 1 for each region that is reached from region 0, else 0. A region is reached through a
  // contact from another one if enter(other, contact, region) is true.
  template <class Enter>
  std::vector<char> reached(const Enter& enter) const {
    std::vector<char> reached(at_.size(), 0);
    std::vector<std::int32_t> front{0};
    reached[0] = 1;
    for (std::size_t k = 0; k < front.size(); ++k) {
      const std::int32_t from = front[k];
      for (const std::size_t c : at_[index(from)]) {
        const std::int32_t next = contacts_[c][0] == from ? contacts_[c][1] : contacts_[c][0];
        if (reached[index(next)] != 0 || !enter(from, c, next)) continue;
        reached[index(next)] = 1;
        front.push_back(next);
      }
    }
    return reached;
  }

 private:
  std::vector<std::array<std::int32_t, 2>> contacts_;
  std::vector<std::vector<std::size_t>> at_;  // the contacts of each region
};

}  // namespace pnpbs
