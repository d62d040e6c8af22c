// SPDX-License-Identifier: BSD-3-Clause
// How many nodes d asks for on surfaces.
#pragma once

#include <vector>

#include "domain/spacing_evaluator.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// The integral of 1/d^2 over the triangles. Those that hold many of the nodes, and over which d
// varies, are divided; dips of d between the corners and the middle of a large one are not seen.
double nodes_on_triangles(std::vector<FacetCorners<3>> triangles,
                          const SpacingEvaluator<3>& spacing);

}  // namespace pnpbs
