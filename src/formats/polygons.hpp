// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of polygons in surface files.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "formats/surface_triangles.hpp"

namespace pnpbs {

// Adds a polygon to the surface as triangles of the same orientation. The polygon may be
// non-convex, have corners on straight edges, and be slightly curved. Triangles are added even if
// degenerate, as are polygons that become triangles, or less, without repeated consecutive corners.
// Returns an error text if the polygon cannot be divided; then nothing is added. An empty string
// means success.
std::string add_polygon(SurfaceTriangles& surface, std::span<const std::int32_t> corners,
                        std::int32_t tag);

}  // namespace pnpbs
