// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets that can be joined (union-find). The root of a set is its smallest member.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pnpbs {

// A partition of the numbers 0 .. count-1 into disjoint sets.
template <class Index>
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { separate_all(); }
  // Makes each member a set of its own again.
  void separate_all() { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index root(Index x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace pnpbs
