// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists (section 2.3) and the Delaunay stars of a level, and the ghosts that the
// stars need. The hops of an exchange bring what lies within a few spacings; where d jumps, or the
// nodes are far too few for d, the circle of a triangle may reach farther. Then the ranks that own
// what lies there are asked.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

void rebuild_lists_for_steps(Level& level);
// At the present positions.
void rebuild_lists(Level& level, double radius);
// From these, on one rank.
void rebuild_stars(Level& level);

// Right after an exchange that deep: lists, and the stars of the owned nodes and of the ghosts
// around them, up to so many neighbours away. Collective.
void make_lists_and_stars(Level& level, int hops, double radius, int rings);
// The same where the lists are there. Collective.
void make_stars(Level& level, int hops, double radius, int rings);

// The lists handed out. Over several ranks with the ghosts that the stars need, and the stars.
// Collective.
void prepare_lists(Level& level);

}  // namespace pnpbs
