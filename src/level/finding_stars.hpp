// SPDX-License-Identifier: BSD-3-Clause
// The search for the Delaunay stars of a level, from its lists: the stars of the owned nodes and of
// ghosts around them, as far as the known nodes of other ranks suffice.
#pragma once

#include <vector>

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// Returns whether no node on any rank has moved, appeared or vanished since the stored stars were
// found. Sets level.stars_digest to that of the present nodes. Returns false in the plane. All
// ranks must call it, and if one rank throws, all ranks throw.
bool stars_hold(Level<2>& level);
bool stars_hold(Level<3>& level);

// Finds the stars of the owned nodes and of the ghosts to the depth `zone`. If `stored_stars_hold`
// is true, only missing ones are computed. Returns the boxes that must be known for stars it cannot
// find. If the result is empty on all ranks, all stars are found. All ranks must call it, and if
// one rank throws, all ranks throw.
std::vector<Box<2>> find_stars(Level<2>& level, const KnownRegion<2>& known,
                               const GhostStarDepth& zone, bool stored_stars_hold);
std::vector<Box<3>> find_stars(Level<3>& level, const KnownRegion<3>& known,
                               const GhostStarDepth& zone, bool stored_stars_hold);

// Keeps the stars of the owned nodes that have been found, which remain valid when more ghosts are
// known, for the next search. Returns whether it may use them. Call it before nodes are added. All
// ranks must call it, and if one rank throws, all ranks throw.
bool keep_found_stars(Level<2>& level);
bool keep_found_stars(Level<3>& level);

// Finds the stars of all nodes, on one rank.
template <int Dim>
void rebuild_stars(Level<Dim>& level);

// Restores the stars of the plane by flips, without lists, after nodes have moved a little. Returns
// false if that is impossible, in space, or on several ranks; the stars may be invalid then.
bool restore_stars(Level<2>& level);
bool restore_stars(Level<3>& level);

// Returns the data that stars are computed from. The result refers to both arguments.
VolumeStarInput star_input(const Level<3>& level, const KnownRegion<3>& known);

}  // namespace pnpbs
