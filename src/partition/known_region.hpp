// SPDX-License-Identifier: BSD-3-Clause
// Where a rank knows every node: in the leaves of the background tree whose nodes it holds, owned
// or as ghosts, and in boxes it has asked the other ranks about.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "domain/domain_map.hpp"

namespace pnpbs {

class KnownRegion {
 public:
  KnownRegion() = default;  // everywhere
  KnownRegion(const DomainMap& map, const std::vector<char>& held_leaves);

  bool is_everywhere() const { return unknown_in_.empty(); }
  void add(const Box<2>& box) { boxes_.push_back(box); }

  // Is all of the box known that lies in the domain?
  bool covers(const DomainMap& map, const Box<2>& box) const {
    if (is_everywhere()) return true;
    if (std::any_of(boxes_.begin(), boxes_.end(),
                    [&](const Box<2>& known) { return contains(known, box); }))
      return true;
    bool all = true;
    const auto look = [&](std::int32_t cell) {
      return all && unknown_in_[static_cast<std::size_t>(cell)] != 0;
    };
    map.tree().for_leaves_in(box, look, [&](std::int32_t) { all = false; });
    return all;
  }

 private:
  static bool contains(const Box<2>& outer, const Box<2>& inner) {
    for (int k = 0; k < 2; ++k)
      if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    return true;
  }

  std::vector<char> unknown_in_;  // of each cell of the tree, is any leaf; empty: all are known
  std::vector<Box<2>> boxes_;
};

inline KnownRegion::KnownRegion(const DomainMap& map, const std::vector<char>& held_leaves)
    : unknown_in_(static_cast<std::size_t>(map.tree().cell_count()), 0) {
  // Children come behind their parents.
  for (std::int32_t c = map.tree().cell_count() - 1; c >= 0; --c) {
    const BackgroundTree<2>::Cell& cell = map.tree().cell(c);
    char& unknown = unknown_in_[static_cast<std::size_t>(c)];
    if (cell.first_child < 0)
      unknown = !held_leaves[static_cast<std::size_t>(cell.leaf)] && !map.leaf_outside(cell.leaf);
    for (int k = 0; cell.first_child >= 0 && k < BackgroundTree<2>::kChildren; ++k)
      unknown = unknown || unknown_in_[static_cast<std::size_t>(cell.first_child + k)];
  }
}

}  // namespace pnpbs
