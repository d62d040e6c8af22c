// SPDX-License-Identifier: BSD-3-Clause
// Where the triangulation of a level set's surface leaps over its edges and corners: triangles with
// vertices on two sides or more.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "implicit/level_set_kinks.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// The edge between two vertices, the lower one first.
inline std::array<std::int32_t, 2> edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// An edge between triangles over which the surface has an edge.
struct CreaseCrossing {
  std::array<std::int32_t, 2> vertices;  // ascending
  CreasePoint at;                        // its normals are of the sides of these vertices
};

struct SurfaceCorner {
  Point<3> position;
  Point<3> up;                         // unit: all sides look there
  std::vector<std::int32_t> vertices;  // next to it, nearest first
};

struct LevelSetCrossings {
  std::vector<Point<3>> normals;  // unit, of f at the vertices; 0 where no edge is near
  std::vector<CreaseCrossing> edges;
  std::vector<SurfaceCorner> corners;
};

// If `third_sides`, adds vertices where an edge between triangles leaps over a third side, as
// beside corners.
LevelSetCrossings find_crossings(const LevelSet& set, SurfaceSource& smooth, bool third_sides);

}  // namespace pnpbs
