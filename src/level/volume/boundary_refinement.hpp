// SPDX-License-Identifier: BSD-3-Clause
// The insertion of surface nodes where the boundary of the tetrahedra leaves the surfaces, by
// restricted Delaunay refinement (Chew, "Guaranteed-quality mesh generation for curved surfaces",
// 1993; Boissonnat and Oudot, "Provably good sampling and meshing of surfaces", 2005). For each
// boundary face with an inner node, and for the largest face at each node whose faces are not one
// disk, a node is inserted at the surface point that is the centre of a ball through the corners of
// the face. This is repeated as long as the number of such faces decreases. If the boundary is
// still torn, inner nodes block it and are removed (blocking_nodes.hpp).
#pragma once

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// The surfaces at which nodes are inserted.
enum class RefinedSurfaces { boundary, boundary_and_inner };

// Refines the boundary. With inner surfaces, also inserts nodes on these at faces between
// tetrahedra that cross them (inner_facets.hpp). Afterwards the level has the stars of the last
// round with settled elements, or no stars. Returns the numbers of inserted and deleted nodes over
// all ranks. Does nothing in the plane. All ranks must call it, and if one rank throws, all ranks
// throw.
PopulationCounts refine_boundary(Level<3>& level, RefinedSurfaces surfaces);
inline PopulationCounts refine_boundary(Level<2>&, RefinedSurfaces) { return {}; }

}  // namespace pnpbs
