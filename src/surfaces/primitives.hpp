// SPDX-License-Identifier: BSD-3-Clause
// Box, ball and cylinder as triangulated surfaces, their normals pointing out.
#pragma once

#include <array>
#include <cstdint>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Twelve triangles. Tags of the sides at low x, high x, low y, high y, low z, high z.
SurfaceSource box_surface(const Point<3>& low, const Point<3>& high,
                          const std::array<std::int32_t, 6>& tags);

// An icosahedron whose triangles are cut into four six times: 81 920 of them. Their vertices are on
// the sphere, the triangles within 1e-4 of the radius.
SurfaceSource ball_surface(const Point<3>& centre, double radius, std::int32_t tag);

// With 256 strips from circle to circle, likewise within 1e-4 of the radius.
SurfaceSource cylinder_surface(const Point<3>& begin, const Point<3>& end, double radius,
                               std::int32_t tag);

}  // namespace pnpbs
