// SPDX-License-Identifier: BSD-3-Clause
// Boxes, balls and cylinders as triangulated surfaces with outward normals.
#pragma once

#include <array>
#include <cstdint>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Returns twelve triangles. The tags are those of the sides at low x, high x, low y, high y, low z,
// high z.
SurfaceSource box_surface(const Point<3>& low, const Point<3>& high,
                          const std::array<std::int32_t, 6>& tags);

// Returns an icosahedron subdivided six times, with 81 920 triangles. Vertices lie on the sphere,
// and triangles within 1e-4 of the radius of it.
SurfaceSource ball_surface(const Point<3>& centre, double radius, std::int32_t tag);

// Returns a ball with a quarter of the triangles, which lie within 3e-4 of the radius of the
// sphere.
SurfaceSource coarser_ball(SurfaceSource ball);

// Returns a cylinder of 256 strips between its end circles, also within 1e-4 of the radius.
SurfaceSource cylinder_surface(const Point<3>& begin, const Point<3>& end, double radius,
                               std::int32_t tag);

}  // namespace pnpbs
