// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay stars of ghosts in bodies. A star is a function of the nodes, so a rank receives it
// from the owner of the ghost.
#pragma once

#include <cstdint>

#include "base/function_ref.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Receives the stars of the ghosts in `rings` rings around the owned nodes, whose stars must have
// been found. Where a star contains nodes that this rank does not have, it calls request(i, reach)
// instead: all nodes within `reach` of ghost i must be known. All ranks must call it, and if one
// rank throws, all ranks throw.
void receive_ghost_stars(Level<3>& level, int rings,
                         FunctionRef<void(std::int64_t i, double reach)> request);

}  // namespace pnpbs
