// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "formats/surface_triangles.hpp"

namespace pnpbs {

// Adds a polygon of the surface's vertices, in triangles of the same orientation: convex or not,
// with corners on straight edges or not, and flat or nearly. A triangle is added whatever its
// corners are, and so is what has no more of them, but for some that follow each other and are the
// same. Returns what is wrong with it; nothing is added then.
std::string add_polygon(SurfaceTriangles& surface, std::span<const std::int32_t> corners,
                        std::int32_t tag);

}  // namespace pnpbs
