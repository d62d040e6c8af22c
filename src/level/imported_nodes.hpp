// SPDX-License-Identifier: BSD-3-Clause
// The import of nodes into a level. They are migrated to their owners, thinned where they are too
// dense, and numbered.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// The counts of an import, on all ranks.
struct ImportedNodes {
  std::int64_t left_out = 0;  // outside the domain, or too close to its boundary
  std::int64_t thinned = 0;   // deleted because they were too dense for d
  std::int64_t numbered = 0;  // without an id before
};

// Returns the boundary nodes of a level, with the ids of incoming nodes where these match.
BoundaryNodes<2> boundary_nodes(const LevelGeometry<2>& geometry, const IncomingNodes<2>& incoming);
BoundaryNodes<3> boundary_nodes(const LevelGeometry<3>& geometry, const IncomingNodes<3>& incoming);

// Makes the incoming nodes those of the level. Ids from next_id on must be free. All ranks must
// call it, and if one rank throws, all ranks throw.
template <int Dim>
ImportedNodes take(Level<Dim>& level, IncomingNodes<Dim> incoming, std::int64_t next_id);

}  // namespace pnpbs
