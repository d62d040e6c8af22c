// SPDX-License-Identifier: BSD-3-Clause
// Sets that are joined one by one; each is known by its least member.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pnpbs {

template <class Index>
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { part_all(); }
  // Each is a set of its own again.
  void part_all() { std::iota(parent_.begin(), parent_.end(), Index{0}); }
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
