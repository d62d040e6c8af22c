// SPDX-License-Identifier: BSD-3-Clause
// Estimates the number of nodes on surfaces.
#pragma once

#include <vector>

#include "domain/spacing_evaluator.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Returns the integral of the node density over the triangles. Triangles with many nodes and
// varying d are subdivided. Minima of d between the samples of a large triangle are not detected.
double nodes_on_triangles(std::vector<FacetCorners<3>> triangles,
                          const SpacingEvaluator<3>& spacing);

}  // namespace pnpbs
