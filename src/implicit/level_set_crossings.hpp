// SPDX-License-Identifier: BSD-3-Clause
// Finds the edges and corners of a level set's surface that its smooth triangulation misses:
// triangles there have vertices on two sides or more.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "implicit/level_set_kinks.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Returns the edge between two vertices, the lower one first.
inline std::array<std::int32_t, 2> edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// A point at which an edge of the surface crosses an edge of the triangulation.
struct CreaseCrossing {
  std::array<std::int32_t, 2> vertices;  // ascending
  CreasePoint at;                        // its normals are those of the sides of these vertices
};

// A corner of the surface.
struct SurfaceCorner {
  Point<3> position;
  Point<3> up;                         // unit; all sides face this direction
  std::vector<std::int32_t> vertices;  // vertices near it, nearest first
};

// All edges and corners found, and normals of f.
struct LevelSetCrossings {
  std::vector<Point<3>> normals;  // unit, at the vertices; 0 if no edge is near
  std::vector<CreaseCrossing> edges;
  std::vector<SurfaceCorner> corners;
};

// Finds the crossings. With `third_sides`, adds vertices to `smooth` where an edge of the
// triangulation skips a third side of the surface, as happens beside corners.
LevelSetCrossings find_crossings(const LevelSet& set, SurfaceSource& smooth, bool third_sides);

}  // namespace pnpbs
