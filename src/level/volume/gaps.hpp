// SPDX-License-Identifier: BSD-3-Clause
// Gaps between the nodes that a level in space has taken over from a coarser one. In a wall thinner
// than its spacing the coarser level had no inner nodes. There is then no node to refine, and no
// bubble beside which population control inserts others. A fill closes such gaps.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

// Returns whether a node is closer to the candidate than `gap` times its d, on the same side of the
// surface. Uses the buckets of the present lists.
bool is_covered(const Level<3>& level, const IncomingNode<3>& candidate, double gap);

// Returns the candidates that lie in cells of this rank and are not covered (is_covered). All ranks
// must call it, and if one rank throws, all ranks throw.
IncomingNodes<3> in_gaps(Level<3>& level, const IncomingNodes<3>& candidates,
                         double gap = method::kGap);

// Fills the gaps in the inside. Returns the number of new nodes over all ranks. All ranks must call
// it, and if one rank throws, all ranks throw.
std::int64_t fill_gaps_inside(Level<3>& level);
// Does nothing in the plane.
inline std::int64_t fill_gaps_inside(Level<2>&) { return 0; }

}  // namespace pnpbs
