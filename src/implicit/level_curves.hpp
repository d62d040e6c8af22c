// SPDX-License-Identifier: BSD-3-Clause
// The curves that bound a region of the plane given by a function: marching squares, with vertices
// put into the corners.
#pragma once

#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// A part of a loop, straight between its points; the region is on the left.
struct LevelCurve {
  bool closed;  // else it leads from a corner to a corner
  std::vector<Point<2>> points;
};

// By loops: those of where f < 0, in a box that has no extent in z. Vertices are where f = 0, in
// distances of about the resolution; a corner is where the gradient of f jumps by more than 20
// degrees, but sharp ones may lose so much of their tips as fits between points of the lattice.
// Throws Error(ErrorKind::domain) if f is negative nowhere, or on the border of the box.
std::vector<std::vector<LevelCurve>> level_curves(const LevelSet& set);

}  // namespace pnpbs
