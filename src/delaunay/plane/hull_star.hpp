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

// The part of the star between two neighbours that are in it for certain, counter-clockwise from
// `first` to `last`, both included (-1 and -1: the whole star, its first neighbour once more at the
// end). Of nodes beyond a sector nothing is seen. False if the star is not closed in between.
bool sector_star(const StarPoint& centre, std::int32_t first, std::int32_t last,
                 std::vector<StarPoint>& around);

// Which sides of the triangle (centre, a, b) are edges of the triangulation whatever lies near.
struct FixedSides {
  bool to_a, to_b, ab;
};

// How far from the centre a node could lie that would spoil the triangle. Beyond a fixed side
// nothing is seen. In the part of the circle cut off by a side that the circle's middle is not
// beyond, nothing is farther than the ends of that side.
double needed_reach(const Point<2>& centre, const Point<2>& a, const Point<2>& b,
                    const FixedSides& fixed);

// Diameter of the circle through a, b, c, not less (infinity for three points on a line).
double circle_diameter(const Point<2>& a, const Point<2>& b, const Point<2>& c);

}  // namespace pnpbs
