// SPDX-License-Identifier: BSD-3-Clause
// How far the boundary of the tetrahedra and the surfaces of a body are from each other.
#pragma once

#include "results/results.hpp"

namespace pnpbs {

// The largest distances over d, of the boundary faces from the surfaces and of the surfaces from
// the boundary faces. 0 of other kinds of domains.
struct BoundaryDistance {
  double of_faces = 0, of_surfaces = 0;
};

// Faces are measured at their centroids and the middles of their sides; surfaces at points no
// farther apart than d. Every rank holds all faces of the boundary meanwhile. After
// prepare_stars. Collective.
BoundaryDistance boundary_distance(const Results<2>& results);
BoundaryDistance boundary_distance(const Results<3>& results);

}  // namespace pnpbs
