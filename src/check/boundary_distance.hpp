// SPDX-License-Identifier: BSD-3-Clause
// Distances between the boundary of the tetrahedra and the surfaces of a body.
#pragma once

#include "results/results.hpp"

namespace pnpbs {

// The largest distances over d, of boundary faces from the surfaces and of the surfaces from the
// boundary faces. Both are 0 for other kinds of domains.
struct BoundaryDistance {
  double of_faces = 0, of_surfaces = 0;
};

// Computes the distances. Faces are sampled at their centroids and edge midpoints, surfaces at
// points at most d apart. Every rank stores all boundary faces during the call. Requires
// prepare_stars(). Collective.
BoundaryDistance boundary_distance(const Results<2>& results);
BoundaryDistance boundary_distance(const Results<3>& results);

}  // namespace pnpbs
