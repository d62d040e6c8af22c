// SPDX-License-Identifier: BSD-3-Clause
// The middles of edges that represent parts of curves and surfaces: points of these, as elements of
// second order need them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "level/level.hpp"

namespace pnpbs {

// An edge between two nodes, given by their memory indices, and its middle.
template <int Dim>
struct EdgeMiddle {
  std::array<std::int64_t, 2> nodes;
  Point<Dim> x;  // in the coordinates of the level
};

// Moves the middles of edges of facets to the curves and surfaces that the facets represent. In the
// plane it is the point of the curve halfway between the nodes, along a feature edge in space
// likewise, and on a surface the point of a common patch of both nodes that is nearest to `x`. On
// level sets it is on f = 0. A middle stays if no point of the surface is nearer than a quarter of
// the edge. The result depends only on the edge itself.
void move_to_boundary(const Level<2>& level, std::span<EdgeMiddle<2>> edges);
void move_to_boundary(const Level<3>& level, std::span<EdgeMiddle<3>> edges);

}  // namespace pnpbs
