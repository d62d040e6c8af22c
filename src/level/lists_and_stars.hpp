// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists (section 2.3) and the Delaunay stars of a level, and the ghosts that the
// stars need. The hops of an exchange bring what lies within a few spacings; where d jumps, or the
// nodes are far too few for d, the circle of a triangle may reach farther. Then the ranks that own
// what lies there are asked.
#pragma once

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"

namespace pnpbs {

template <int Dim>
void rebuild_lists_for_steps(Level<Dim>& level, ListsOf listed = ListsOf::all_nodes);
// At the present positions.
template <int Dim>
void rebuild_lists(Level<Dim>& level, double radius, ListsOf listed = ListsOf::all_nodes);

// Right after an exchange that deep: lists, and the stars of the owned nodes and of the ghosts
// in that zone around them. Collective.
template <int Dim>
void make_lists_and_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone);
// The same where the lists are there. Collective.
template <int Dim>
void make_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone);

// Keeps the stars there are, if they are of the nodes there are, for those that are made next:
// before nodes are exchanged or sorted. Collective.
template <int Dim>
void take_stars(Level<Dim>& level);

// Afterwards a rank knows all nodes within radius times the largest d of each leaf in which it owns
// any: all those near its own nodes, whatever lies between. (Of a whole sphere, which has no
// particles, only what lists may hold.) Lists are there. Collective.
template <int Dim>
void make_known_around(Level<Dim>& level, double radius);

// The lists handed out. Over several ranks with the ghosts that the stars need, and the stars.
// Collective.
template <int Dim>
void prepare_lists(Level<Dim>& level);

}  // namespace pnpbs
