// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists (section 2.3) and the Delaunay stars of a level, and the ghosts that the
// stars need. The hops of an exchange cover a few spacings. Where d jumps, or the nodes are far too
// few for d, the circumcircle of a triangle may reach farther; the ranks that own that region then
// send their nodes.
#pragma once

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Sorts the nodes in memory by bucket, as every rebuild of lists does. Local.
template <int Dim>
void sort_nodes(Level<Dim>& level);
// Builds the lists for steps, with visibility at the reference positions. Local.
template <int Dim>
void rebuild_lists_for_steps(Level<Dim>& level, ListsOf listed = ListsOf::all_nodes);
// Builds lists of this radius at the present positions. Local.
template <int Dim>
void rebuild_lists(Level<Dim>& level, double radius, ListsOf listed = ListsOf::all_nodes);

// Builds lists, and finds the stars of the owned nodes and of the ghosts to the depth `zone`. An
// exchange of depth `hops` must precede. All ranks must call it, and if one rank throws, all ranks
// throw.
template <int Dim>
void make_lists_and_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone);
// Finds the same stars with the present lists. All ranks must call it, and if one rank throws, all
// ranks throw.
template <int Dim>
void make_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone);

// Stores the present stars, if they belong to the present nodes, for the next search of stars. Call
// it before nodes are exchanged or sorted. All ranks must call it, and if one rank throws, all
// ranks throw.
template <int Dim>
void take_stars(Level<Dim>& level);

// Fetches ghosts until the rank knows all nodes within radius times the largest d of each leaf in
// which it owns nodes, whatever lies between. On a whole sphere, which has no particles, it fetches
// only nodes that lists may contain. Requires lists. All ranks must call it, and if one rank
// throws, all ranks throw.
template <int Dim>
void make_known_around(Level<Dim>& level, double radius);

// Builds the lists that are extracted as results. On several ranks it also finds the stars, and the
// ghosts are those that the stars need. All ranks must call it, and if one rank throws, all ranks
// throw.
template <int Dim>
void prepare_lists(Level<Dim>& level);

}  // namespace pnpbs
