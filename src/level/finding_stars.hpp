// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay stars of a level from its lists: those of the owned nodes and of the ghosts around
// them, as far as what is known of other ranks' nodes suffices.
#pragma once

#include <vector>

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// Has no node moved, come or gone, on any rank, since the stars were found that were taken last?
// From now on level.stars_digest is that of the nodes now. In the plane: no. Collective.
bool stars_hold(Level<2>& level);
bool stars_hold(Level<3>& level);

// Finds the stars of the owned nodes and of the ghosts in that zone around them; if those taken
// hold, only what is missing. Returns what must be known for those that it could not find; nothing
// on all ranks: they are all there. Collective.
std::vector<Box<2>> find_stars(Level<2>& level, const KnownRegion<2>& known,
                               const GhostStarDepth& zone, bool taken_hold);
std::vector<Box<3>> find_stars(Level<3>& level, const KnownRegion<3>& known,
                               const GhostStarDepth& zone, bool taken_hold);

// Of all nodes, on one rank.
template <int Dim>
void rebuild_stars(Level<Dim>& level);

// The same in the plane where those there are were found before the nodes moved a little, without
// lists. False if they were not, or on several ranks: then they are as they were, or worth nothing.
bool restore_stars(Level<2>& level);
bool restore_stars(Level<3>& level);

// What the stars are made from; the region must outlive it.
VolumeStarInput star_input(const Level<3>& level, const KnownRegion<3>& known);

}  // namespace pnpbs
