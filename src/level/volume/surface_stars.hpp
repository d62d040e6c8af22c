// SPDX-License-Identifier: BSD-3-Clause
// The stars of boundary nodes within their surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/volume/tangent_star.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Are two nodes next to each other on a feature curve?
bool joined(const LevelGeometry<3>& geometry, const Nodes<3>& nodes, std::int64_t i,
            std::int64_t j);

// The star of a node of the boundary from the level's lists, side after side, each
// counter-clockwise as seen from outside; empty if it is not known. The lists are those made while
// bubbles are on surfaces, which hold just what is seen there.
std::vector<SurfaceStarEntry> surface_star(const Level<3>& level, std::int64_t i);

}  // namespace pnpbs
