// SPDX-License-Identifier: BSD-3-Clause
// Which nodes of a level have no room: between boundary edges, or on top of another node.
#pragma once

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Is there room at x for a node that d is the spacing of: inside, and clear of the boundary?
bool has_clearance(const Level& level, const Point<2>& x, double d);

// A flag for each node that is between boundary edges, or on top of another node: of two that
// nearly coincide it is the one with the larger id. Lists must be fresh, and made where the nodes
// are.
View<char> nodes_without_room(const Level& level);

// At the end of a run, before its sweeps: such nodes go. Counts are of this rank. Collective.
PopulationCounts remove_crowded(Level& level);

}  // namespace pnpbs
