// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a level that have no room: between boundary edges, or at the point of another node.
#pragma once

#include <type_traits>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Returns whether a new node with spacing d has room at x: inside the domain, and far enough from
// its boundary.
template <int Dim>
bool has_clearance(const Level<Dim>& level, const std::type_identity_t<Point<Dim>>& x, double d);

// Returns a flag for each node without room. Of two nodes that nearly coincide, the one with
// the larger id has none. The lists must have been built at the present positions.
template <int Dim>
View<char> nodes_without_room(const Level<Dim>& level);

// Deletes the nodes without room at the end of a run, before its sweeps. Returns the counts of this
// rank. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
PopulationCounts remove_crowded(Level<Dim>& level);

}  // namespace pnpbs
