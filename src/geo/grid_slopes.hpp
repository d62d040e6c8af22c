// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geo/grid.hpp"

namespace pnpbs::geo {

// How steep the values on a grid are: their change per unit of the points' coordinates, or, where
// the radius is not 0, per length along the sphere on which points have these degrees.
void evaluate_slopes(const Grid& grid, double radius, const std::vector<Point<2>>& points,
                     double* slopes);

}  // namespace pnpbs::geo
