// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a domain in the plane or on a sphere as closed walks with the domain on their
// left: counter-clockwise around the outside, clockwise around islands. Inner curves bound nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "io/node_source.hpp"

namespace pnpbs {
class Communicator;
}

namespace pnpbs::io {

struct LoopEdge {
  std::int64_t begin, end;  // numbers of nodes
  std::int32_t tag;

  auto operator<=>(const LoopEdge&) const = default;
};

struct BoundaryLoop {
  std::vector<LoopEdge>
      edges;       // each begins where the one before it ends, the first where the last
  bool is_island;  // else it goes around a part of the domain
};

// Walks that meet no node twice: where loops touch they are told apart. Those around the domain
// come first. All of them on each rank, as the boundary is anyway, in the same order on any number
// of ranks. On a sphere, where both sides of a loop are bounded, the land of an island is less than
// half of it. Collective.
std::vector<BoundaryLoop> boundary_loops(const NodeSource& nodes, const Communicator& comm);

// A part of a loop, all of one kind.
struct BoundaryChain {
  std::vector<std::int64_t> nodes;  // numbers; of a whole loop the first one is the last one, too
  std::int32_t kind;
  bool is_closed;  // a whole loop
  bool is_island;  // of one
};

// Each loop in turn, cut where its kind changes. kind_of: by tag.
std::vector<BoundaryChain> chains_of(const std::vector<BoundaryLoop>& loops,
                                     const std::function<std::int32_t(std::int32_t)>& kind_of);

}  // namespace pnpbs::io
