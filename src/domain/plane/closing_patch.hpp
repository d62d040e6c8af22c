// SPDX-License-Identifier: BSD-3-Clause
// The patch that closes a whole sphere around the point from which its chart is projected. That
// point has no position in the chart, and bubbles grow without bound towards it. The nodes around
// it are therefore placed first and then fixed.
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Largest d at that point. [radius of the sphere] On a sphere with only some hundred nodes, a
// larger d leaves no room for a patch.
inline constexpr double kMostAtPoint = 0.25;

// Nodes that close a whole sphere, and the radii of the patch. Radii are distances from the chart's
// origin; the patch lies beyond them.
struct ClosingPatch {
  // Corners, on the sphere, of the triangle around the point. Its inside is the only part of the
  // sphere outside the chart's domain.
  std::array<Point<3>, 3> rim;
  std::vector<Point<2>> nodes;  // the other nodes, in the chart
  double edge = 0;              // smallest distance of `nodes` from the origin of the chart
  double beyond = 0;            // largest distance of `nodes` from the origin of the chart
  double margin = 0;            // nodes between `edge` and this radius move in the finish
  double d = 0;  // spacing along the sphere at the point, for which the patch was made
};

}  // namespace pnpbs
