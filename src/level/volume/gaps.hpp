// SPDX-License-Identifier: BSD-3-Clause
// Gaps between the nodes that a level in space took over from a coarser one: where that had no room
// for nodes, as in a wall thinner than its spacing, there is none to be refined, and no bubble
// beside which others would come. There a fill helps.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

// Is a node nearer to this new one than so many of its d, on its side of the surface? By the lists'
// buckets.
bool is_covered(const Level<3>& level, const IncomingNode<3>& candidate, double gap);

// Of these new nodes, those that this rank owns and that are so many of their d away from all that
// the level has. Collective.
IncomingNodes<3> in_gaps(Level<3>& level, const IncomingNodes<3>& candidates,
                         double gap = method::kGap);

// Puts a fill of the inside into the gaps there. Returns how many nodes that is, of all ranks.
// Collective.
std::int64_t fill_gaps_inside(Level<3>& level);
// Fills nothing in the plane.
inline std::int64_t fill_gaps_inside(Level<2>&) { return 0; }

}  // namespace pnpbs
