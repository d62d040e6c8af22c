// SPDX-License-Identifier: BSD-3-Clause
// Nodes that come to the surfaces where the boundary of the tetrahedra leaves them: restricted
// Delaunay refinement (Chew, "Guaranteed-quality mesh generation for curved surfaces", 1993;
// Boissonnat and Oudot, "Provably good sampling and meshing of surfaces", 2005). A face of the
// boundary with a node from inside, and the largest face at a node around which the faces are not
// one disk, get a node in the middle of the ball around a point of the surface that their corners
// lie on, round after round, as long as that makes them fewer. Where the
// boundary is torn still, nodes from inside are in the way, and leave (blocking_nodes.hpp).
#pragma once

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Leaves the stars of its last round, with their elements settled, or none. Returns how many nodes
// came and left, over all ranks. Collective.
PopulationCounts refine_boundary(Level<3>& level);
inline PopulationCounts refine_boundary(Level<2>&) { return {}; }

}  // namespace pnpbs
