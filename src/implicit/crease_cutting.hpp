// SPDX-License-Identifier: BSD-3-Clause
// The triangulation of a level set's surface is cut where the surface has edges: as in the
// extended marching cubes of Kobbelt and others (2001), vertices come onto the edges and corners,
// but the vertices next to them are moved there, so that no needles are left.
#pragma once

#include <cstdint>
#include <vector>

#include "implicit/level_set_crossings.hpp"

namespace pnpbs {

struct CutSurface {
  std::vector<Point<3>> vertices;  // those of the smooth surface first
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> origins;  // of each the triangle of the smooth surface
  std::vector<char> on_crease;        // of the vertices
};

// Care to be taken at vertices of the smooth surface: 0, and vertices move; 1, they stay, but edges
// that end there are cut; kLeftAlone, nothing is done there.
inline constexpr char kLeftAlone = 2;

CutSurface cut_at_creases(const SurfaceSource& smooth, const LevelSetCrossings& crossings,
                          const std::vector<char>& care, double resolution);

}  // namespace pnpbs
