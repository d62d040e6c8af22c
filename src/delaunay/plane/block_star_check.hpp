// SPDX-License-Identifier: BSD-3-Clause
// Are the stars of a block of nodes still Delaunay where the nodes are now? One node per SIMD lane,
// as far as plain floating point can prove it.
#pragma once

#include <cstdint>

#include "delaunay/delaunay_stars.hpp"

namespace pnpbs {

struct BlockStarCheck {
  // Proven to turn once around the node, and to be convex where it is inverted: each edge from the
  // node is locally Delaunay. Only of stars that are all triangles.
  bool holds[kLanes];
  // Of those: is the first neighbour nearer than all others?
  bool begins_with_nearest[kLanes];
};

// x, y: positions of all nodes, and of the far-away one behind them.
void check_block_stars(const DelaunayStars::Block& stars, const double* x, const double* y,
                       const std::int64_t (&self)[kLanes], BlockStarCheck& check);

}  // namespace pnpbs
