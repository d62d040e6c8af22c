// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// A counter-clockwise polygon in the plane, in triangles of its corners: ears are cut off, then
// edges flipped to a Delaunay triangulation, which is far from needles where corners lie nearly on
// a line. Empty if there is none: the polygon crosses or touches itself or has no area.
std::vector<std::array<std::int32_t, 3>> polygon_triangles(const std::vector<Point<2>>& corners);

}  // namespace pnpbs
