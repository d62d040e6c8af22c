// SPDX-License-Identifier: BSD-3-Clause
// How far nodes on a level set, which are put where it is 0, may be from its triangles.
#pragma once

#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// For BoundaryMesh::node_distance, with some to spare: twice the largest distance at a few places
// on each triangle and in the middle of each edge of the body; no less than rounding makes of
// it, and no more than the resolution of the sets. 0 if there are none.
double largest_node_distance(const ResolvedVolume& volume);

}  // namespace pnpbs
