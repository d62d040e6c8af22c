// SPDX-License-Identifier: BSD-3-Clause
// Elements with small angles that no move of their nodes removes, because the nodes are on the
// boundary. The corners of a rough surface may be much closer to each other than d. Tetrahedra on
// such a short edge have a small angle at the opposite edge, wherever their other nodes are; one
// end of the edge is removed. In a bar or wall as thick as d, four nodes on its sides may lie in a
// plane across it; a node is inserted inside the flat tetrahedron between them.
#pragma once

#include <cstdint>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// The changes made, and the thin elements found.
struct ThinElementChanges {
  PopulationCounts counts;  // on this rank
  std::uint64_t thin = 0;   // number found in the last round, over all ranks
};

// Removes nodes of short edges and inserts nodes in flat elements, in a few rounds.
// Of the ends of a short edge, a node inside a surface is removed rather than one on a curve, and
// that rather than a corner. Fixed nodes of the user are kept. Both ends are kept if the edge
// crosses a wall, a gap or a step where curves or sheets run side by side, because one of these
// would become ragged. Feature nodes that are removed are added to level.left_out.
// Elements at sharp edges of the body and in walls much thinner than d are not changed. Uses the
// present stars, and leaves stars of the owned nodes. All ranks must call it, and if one rank
// throws, all ranks throw.
ThinElementChanges change_nodes_of_thin_elements(Level<3>& level);

}  // namespace pnpbs
