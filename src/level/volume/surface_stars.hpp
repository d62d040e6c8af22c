// SPDX-License-Identifier: BSD-3-Clause
// The stars of boundary nodes within their surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/volume/tangent_star.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Returns whether two nodes are neighbours on a feature curve.
bool joined(const LevelGeometry<3>& geometry, const Nodes<3>& nodes, std::int64_t i,
            std::int64_t j);

// Returns the star of a boundary node from the lists of the level, side by side, each
// counter-clockwise as seen from outside. It is empty if it cannot be found. The lists must be
// those for bubbles on surfaces, which contain only nodes visible along the surface.
std::vector<SurfaceStarEntry> surface_star(const Level<3>& level, std::int64_t i);

}  // namespace pnpbs
