// SPDX-License-Identifier: BSD-3-Clause
// The star of a node with no boundary about: inversion x -> x / |x|^2 about the node turns it into
// the convex hull of the listed neighbours, which a Graham scan finds after a sort by angle.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

struct StarPoint {
  Point<2> position;
  std::int64_t id;
  std::int32_t node;
};

// Sorts `around` and leaves the star of `centre` in it, counter-clockwise. Returns whether the
// star is closed and proven: every circumcircle lies within `reach` of the centre, up to which
// `around` must be complete. If not, `around` is of no use.
bool hull_star(const StarPoint& centre, double reach, std::vector<StarPoint>& around);

// Diameter of the circle through a, b, c, not less (infinity for three points on a line).
double circle_diameter(const Point<2>& a, const Point<2>& b, const Point<2>& c);

}  // namespace pnpbs
