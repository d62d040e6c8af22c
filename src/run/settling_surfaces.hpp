// SPDX-License-Identifier: BSD-3-Clause
// In space, what has the least freedom comes first: nodes on feature edges lie where d asks for
// them, those on surfaces rest as bubbles that cannot leave their surface, and then the inside is
// filled. A simulation of its own moves those on surfaces.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "run/level_context.hpp"
#include "run/outcome.hpp"
#include "run/schedule.hpp"

namespace pnpbs {

// The nodes of the boundary among the incoming ones, which may be from a coarser level, come to
// rest on the level's surfaces, and are handed back so; if there are none, the surfaces are filled.
// If the monitor has stopped the call, or does so here, they stay as they are: the outcome is that
// it is stopped. Collective.
void settle_surfaces(Level<3>& level, IncomingNodes<3>& incoming, Outcome& outcome, LevelRole role,
                     const LevelContext<3>& context);
// Does nothing in the plane, where the nodes of the boundary are laid in their places.
inline void settle_surfaces(Level<2>&, IncomingNodes<2>&, Outcome&, LevelRole,
                            const LevelContext<2>&) {}

// Coarser levels from which the nodes on surfaces come: where these are flat and d is even there,
// one lattice fills each; else a few. Collective.
int surface_levels_that_pay(const Level<3>& finest);
inline int surface_levels_that_pay(const Level<2>&) { return 0; }

// These of the surfaces, or a fill of them if there are none, become the nodes of a level of
// surfaces alone, which the time loop moves. Returns how many of this rank's are too dense for d.
// Collective.
std::int64_t put_on_surfaces(Level<3>& level, IncomingNodes<3> incoming);

// Nodes given anywhere go to the nearest point of the surfaces, unless that is farther than d or
// on top of a feature edge. Returns how many go nowhere.
std::int64_t bring_to_surfaces(const Level<3>& level, IncomingNodes<3>& incoming);

}  // namespace pnpbs
