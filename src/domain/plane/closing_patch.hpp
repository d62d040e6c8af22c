// SPDX-License-Identifier: BSD-3-Clause
// What closes a whole sphere in its chart, which lacks the point that it is projected from: nodes
// about that point, which are laid first and fixed. Towards it bubbles grow in the chart without
// bound, and those that move could not follow.
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Of d at the point: more leave a sphere of some hundred nodes no room for a patch. [of its radius]
inline constexpr double kMostAtPoint = 0.25;

struct ClosingPatch {
  std::array<Point<3>, 3> rim;  // on the sphere: the triangle around the point, whose inside is the
                                // only part of the sphere that has no place in the chart's domain
  std::vector<Point<2>> nodes;  // the others, in the chart
  double edge = 0;              // in the chart: so far from its origin these lie at least,
  double beyond = 0;            // and others at most
  double margin = 0;            // from `edge` to here they move in the finish
  double d = 0;                 // along the sphere at the point: what it was made for
};

}  // namespace pnpbs
