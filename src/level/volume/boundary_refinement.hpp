// SPDX-License-Identifier: BSD-3-Clause
// Nodes that come to the surfaces where the boundary of the tetrahedra leaves them: restricted
// Delaunay refinement (Chew, "Guaranteed-quality mesh generation for curved surfaces", 1993;
// Boissonnat and Oudot, "Provably good sampling and meshing of surfaces", 2005). A face of the
// boundary with a node from inside, and the largest face at a node around which the faces are not
// one disk, get a node in the middle of the ball around a point of the surface that their corners
// lie on, round after round, as long as that makes them fewer.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Leaves the stars of its last round, with their elements settled, or none. Returns how many nodes
// came, over all ranks. Collective.
std::int64_t refine_boundary(Level<3>& level);
inline std::int64_t refine_boundary(Level<2>&) { return 0; }

}  // namespace pnpbs
