// SPDX-License-Identifier: BSD-3-Clause
// The settling of nodes on surfaces, before the inside is filled. Nodes on feature edges are placed
// where d requires them. Nodes on surfaces then come to rest as bubbles that cannot leave their
// surface, in a simulation of their own.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "run/level_context.hpp"
#include "run/outcome.hpp"
#include "run/schedule.hpp"

namespace pnpbs {

// Lets the boundary nodes among `incoming`, which may come from a coarser level, come to rest on
// the surfaces of the level, and replaces them by the result. Without such nodes the surfaces are
// filled. If the monitor has stopped the call, or stops it here, the nodes stay in their present
// state and `outcome` is `stopped`. All ranks must call it, and if one rank throws, all ranks
// throw.
void settle_surfaces(Level<3>& level, IncomingNodes<3>& incoming, Outcome& outcome, LevelRole role,
                     const LevelContext<3>& context);
// Does nothing in the plane, where boundary nodes do not move.
inline void settle_surfaces(Level<2>&, IncomingNodes<2>&, Outcome&, LevelRole,
                            const LevelContext<2>&) {}

// Returns how many coarser levels the nodes on surfaces come from. It is 0 if all surfaces are flat
// and d is nearly constant on them, because one lattice then fills each. Collective.
int surface_levels_that_pay(const Level<3>& finest);
inline int surface_levels_that_pay(const Level<2>&) { return 0; }

// Puts nodes on a level of a surface without a body: the surface nodes among `incoming`, or a fill
// without them. The time loop moves these nodes. Returns how many nodes this rank deletes because
// they are too dense for d. Collective.
std::int64_t put_on_surfaces(Level<3>& level, IncomingNodes<3> incoming);

// Moves given nodes to the nearest points of the surfaces. Drops nodes that are farther than d from
// the surfaces or too close to a feature edge. Returns how many it drops. Local.
std::int64_t bring_to_surfaces(const Level<3>& level, IncomingNodes<3>& incoming);

}  // namespace pnpbs
