// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of a simple polygon in the plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Triangulates a counter-clockwise polygon without new points and returns the indices of the
// corners.
// Ear clipping is followed by flips to a Delaunay triangulation, which has few thin triangles even
// if corners lie nearly on a line. The result is empty if the polygon intersects itself or has no
// area.
std::vector<std::array<std::int32_t, 3>> polygon_triangles(const std::vector<Point<2>>& corners);

}  // namespace pnpbs
