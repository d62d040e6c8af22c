// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a domain in the plane or on a sphere as closed loops with the domain on their
// left: counter-clockwise around the domain, clockwise around islands. Inner curves are no part of
// it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "io/node_source.hpp"

namespace pnpbs {
class Communicator;
}

namespace pnpbs::io {

// A directed edge of the boundary, with the domain on its left.
struct LoopEdge {
  std::int64_t begin, end;  // numbers of nodes
  std::int32_t tag;

  auto operator<=>(const LoopEdge&) const = default;
};

// A closed sequence of edges.
struct BoundaryLoop {
  std::vector<LoopEdge> edges;  // each begins where the one before it ends, cyclically
  bool is_island;               // clockwise around an island; otherwise around a part of the domain
};

// Returns the loops of the boundary. Loops that touch at a node are separate, so a loop passes no
// node twice. Loops around the domain come first. All ranks get all loops, in an order that does
// not depend on the number of ranks. On a sphere both sides of a loop have an area, and an island
// has less than half of the sphere. Collective.
std::vector<BoundaryLoop> boundary_loops(const NodeSource& nodes, const Communicator& comm);

// A part of a loop whose edges all have the same kind.
struct BoundaryChain {
  // Numbers of nodes; a whole loop repeats the first one at the end.
  std::vector<std::int64_t> nodes;
  std::int32_t kind;
  bool is_closed;  // a whole loop
  bool is_island;  // part of a loop around an island
};

// Divides the loops where the kind of their edges changes. `kind_of` maps a tag to a kind.
std::vector<BoundaryChain> chains_of(const std::vector<BoundaryLoop>& loops,
                                     const std::function<std::int32_t(std::int32_t)>& kind_of);

}  // namespace pnpbs::io
