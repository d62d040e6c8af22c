// SPDX-License-Identifier: BSD-3-Clause
// Nodes on their way into a level.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// A node as it comes from outside or from an earlier level.
struct GivenNode {
  Point<2> position;
  std::int64_t id;         // -1: give it one
  bool inner = true;       // a boundary node is laid afresh; one that was there keeps its id
  std::int32_t leaf = -1;  // of the level it is given to, once found
  double d = 0;            // spacing it was placed for; 0 if not known
};

// Leaves the entries of a vector of a given size as they are: all threads write them, and so share
// the cost of touching new memory, which is most of the cost of such a vector.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

using GivenNodes = std::vector<GivenNode, UnsetAllocator<GivenNode>>;

}  // namespace pnpbs
