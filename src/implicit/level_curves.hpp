// SPDX-License-Identifier: BSD-3-Clause
// Curves that bound a region of the plane given by a function: marching squares, with vertices put
// into the corners of the region.
#pragma once

#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// A polyline along the boundary of the region, which lies on its left.
struct LevelCurve {
  bool closed;  // else it leads from a corner to a corner
  std::vector<Point<2>> points;
};

// Returns the boundary curves of the region where f < 0, as closed loops of curves. The box of
// `set` must have no extent in z. Vertices lie at f = 0, about a resolution apart. A corner is a
// point at which the gradient of f turns by more than 20 degrees; sharp corners may lose a part of
// their tip that fits between lattice points.
// Throws Error(ErrorKind::domain) if f is negative nowhere, or on the border of the box.
std::vector<std::vector<LevelCurve>> level_curves(const LevelSet& set);

}  // namespace pnpbs
