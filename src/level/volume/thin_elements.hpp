// SPDX-License-Identifier: BSD-3-Clause
// Elements with small angles that no move of their nodes repairs, because these are on the
// boundary.
//
// The corners of a rough surface may lie much nearer to each other than d. Tetrahedra on such a
// short edge have a small angle at the opposite edge, wherever their other nodes are: one of the
// two nodes is removed. And in a bar or a wall as thick as d, four nodes on its sides may lie in a
// plane across it: the flat tetrahedron between them gets a node inside.
#pragma once

#include <cstdint>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

struct ThinElementChanges {
  PopulationCounts counts;  // of this rank
  std::uint64_t thin = 0;   // elements with small angles that were found last, of all ranks
};

// Removes nodes of short edges and inserts nodes in flat elements, in a few rounds. Of a short
// edge, the node that is removed is one within a surface rather than one on a curve, and this
// rather than a corner. The user's fixed nodes are kept. So are both nodes of an edge across a
// wall, a gap or a step, where curves or sheets of the surface run beside each other: with a node
// less, one of them would be ragged. Nodes removed from features count as left out. Elements at
// sharp edges of the body and in walls much thinner than d do not count. Uses the present stars,
// and leaves stars of the owned nodes. Collective.
ThinElementChanges change_nodes_of_thin_elements(Level<3>& level);

}  // namespace pnpbs
