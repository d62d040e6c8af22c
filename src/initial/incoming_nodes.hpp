// SPDX-License-Identifier: BSD-3-Clause
// Nodes on their way into a level.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/nodes.hpp"

namespace pnpbs {

// A node as the user gives it, as a fill lays it, or as it comes from an earlier level.
template <int Dim>
struct IncomingNode;

template <>
struct IncomingNode<2> {
  Point<2> position;
  std::int64_t id;         // -1: give it one
  bool inner = true;       // a boundary node is laid afresh; one that was there keeps its id
  std::int32_t leaf = -1;  // of the level, once found
  double d = 0;            // spacing it was placed for; 0 if not known

  bool is_inner() const { return inner; }
};

template <>
struct IncomingNode<3> {
  Point<3> position;
  std::int64_t id;
  Carrier carrier = Carrier::free;
  std::int32_t boundary_node = -1;  // see Ground<3>
  std::int32_t tag = 0;
  std::int32_t leaf = -1;
  double d = 0;

  bool is_inner() const { return carrier == Carrier::free; }
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

template <int Dim>
using IncomingNodes = std::vector<IncomingNode<Dim>, UnsetAllocator<IncomingNode<Dim>>>;

}  // namespace pnpbs
