// SPDX-License-Identifier: BSD-3-Clause
// Search for tetrahedra of volume 0. Their nodes lie in one plane and on one sphere, like the
// corners of a rectangle across a bar that is thinner than d, and none of them may move. Solvers
// cannot use such elements.
#pragma once

#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Finds the flat elements among the stars of owned nodes. Each is counted at the corner with the
// smallest id, over all ranks. The corners of this rank's flat elements are appended to `places`.
// Collective.
FoundNodes<3> flat_elements(const Level<3>& level, std::vector<Point<3>>& places);

}  // namespace pnpbs
