// SPDX-License-Identifier: BSD-3-Clause
// Which nodes of a level have no room: between boundary edges, or on top of another node.
#pragma once

#include <type_traits>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Is there room at x for a node that d is the spacing of: inside, and clear of the boundary?
template <int Dim>
bool has_clearance(const Level<Dim>& level, const std::type_identity_t<Point<Dim>>& x, double d);

// A flag for each node that is between boundary edges, or on top of another node: of two that
// nearly coincide it is the one with the larger id. Lists must be fresh, and made where the nodes
// are.
template <int Dim>
View<char> nodes_without_room(const Level<Dim>& level);

// At the end of a run, before its sweeps: such nodes go. Counts are of this rank. Collective.
template <int Dim>
PopulationCounts remove_crowded(Level<Dim>& level);

}  // namespace pnpbs
