// SPDX-License-Identifier: BSD-3-Clause
// Nodes that a new level takes over.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/nodes.hpp"

namespace pnpbs {

// A node given by the user, created by a fill, or taken from an earlier level.
template <int Dim>
struct IncomingNode;

template <>
struct IncomingNode<2> {
  Point<2> position;
  std::int64_t id;         // -1: to be assigned
  bool inner = true;       // false for boundary nodes, which are placed again but keep their ids
  std::int32_t leaf = -1;  // leaf of the level's tree; -1: not yet known
  double d = 0;            // spacing that it was placed for; 0: not known

  bool is_inner() const { return inner; }
};

template <>
struct IncomingNode<3> {
  Point<3> position;
  std::int64_t id;
  Carrier carrier = Carrier::free;
  std::int32_t boundary_node = -1;  // see LevelGeometry<3>
  std::int32_t tag = 0;
  std::int32_t leaf = -1;
  double d = 0;

  bool is_inner() const { return carrier == Carrier::free; }
};

// An allocator that leaves new entries uninitialized. Threads then write them in parallel and share
// the cost of first touching the memory, which dominates for such vectors.
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
