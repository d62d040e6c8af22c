// SPDX-License-Identifier: BSD-3-Clause
// Nodes that a level takes over, wherever they come from: sent to their owners, thinned where they
// are too dense, and numbered.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// What became of incoming nodes, on all ranks.
struct ImportedNodes {
  std::int64_t left_out = 0;  // outside, or too close to the boundary
  std::int64_t thinned = 0;   // too dense for d
  std::int64_t numbered = 0;  // those that came without an id
};

// Of incoming nodes, those that are on the boundary of a level.
BoundaryNodes<2> boundary_nodes(const LevelGeometry<2>& geometry, const IncomingNodes<2>& incoming);
BoundaryNodes<3> boundary_nodes(const LevelGeometry<3>& geometry, const IncomingNodes<3>& incoming);

// Ids from next_id on are free. Collective.
template <int Dim>
ImportedNodes take(Level<Dim>& level, IncomingNodes<Dim> incoming, std::int64_t next_id);

}  // namespace pnpbs
