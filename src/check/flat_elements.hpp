// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra without a volume: between nodes in one plane and on one sphere, as the corners of a
// rectangle across a bar that is thinner than d, none of which may move. No solver can use them.
#pragma once

#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Found at the corner with the least id, over all ranks; this rank's corners are added to `places`.
// By the stars of owned nodes. Collective.
FoundNodes<3> flat_elements(const Level<3>& level, std::vector<Point<3>>& places);

}  // namespace pnpbs
