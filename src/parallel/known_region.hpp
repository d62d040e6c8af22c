// SPDX-License-Identifier: BSD-3-Clause
// Where a rank knows every node: in the leaves of the background tree whose nodes it holds, owned
// or as ghosts, and in boxes it has asked the other ranks about.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/domain_map.hpp"

namespace pnpbs {

class KnownRegion {
 public:
  KnownRegion() = default;  // everywhere
  explicit KnownRegion(std::vector<char> held_leaves) : held_(std::move(held_leaves)) {}

  bool is_everywhere() const { return held_.empty(); }
  void add(const Box<2>& box) { boxes_.push_back(box); }

  // Is all of the box known that lies in the domain?
  bool covers(const DomainMap& map, const Box<2>& box) const {
    if (is_everywhere()) return true;
    if (std::any_of(boxes_.begin(), boxes_.end(),
                    [&](const Box<2>& known) { return contains(known, box); }))
      return true;
    bool all = true;
    map.tree().for_leaves_in(box, [&](std::int32_t leaf) {
      all = all && (held_[static_cast<std::size_t>(leaf)] || map.leaf_outside(leaf));
    });
    return all;
  }

 private:
  static bool contains(const Box<2>& outer, const Box<2>& inner) {
    for (int k = 0; k < 2; ++k)
      if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    return true;
  }

  std::vector<char> held_;  // by leaf; empty: everywhere
  std::vector<Box<2>> boxes_;
};

}  // namespace pnpbs
