// SPDX-License-Identifier: BSD-3-Clause
// The star of a node away from the boundary. Inversion x -> x / |x|^2 about the node transforms it
// to the convex hull of the listed neighbours. A sort by angle and a Graham scan find the hull.
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

// Sorts `around` and reduces it to the star of `centre`, counter-clockwise. Returns whether the
// star is closed and proven, i.e. every circumcircle lies within `reach` of the centre. `around`
// must contain all nodes within `reach`, and is unspecified if the result is false.
bool hull_star(const StarPoint& centre, double reach, std::vector<StarPoint>& around);

// Reduces `around` to the part of the star from neighbour `first` to neighbour `last`,
// counter-clockwise. Both must belong to the star and are included. If both are -1, the result is
// the whole star with its first neighbour repeated at the end. Nodes outside the sector are
// ignored. Returns false if the star is not closed in between.
bool sector_star(const StarPoint& centre, std::int32_t first, std::int32_t last,
                 std::vector<StarPoint>& around);

// Sides of the triangle (centre, a, b) that are edges of the triangulation whatever lies near them.
struct FixedSides {
  bool to_a, to_b, ab;
};

// Returns the distance from the centre up to which a node can invalidate the triangle.
// Nodes beyond a fixed side are not visible. A side cuts the circle into two parts. In the part
// without the circle's centre, no point is farther away than the ends of that side.
double needed_reach(const Point<2>& centre, const Point<2>& a, const Point<2>& b,
                    const FixedSides& fixed);

// Returns the diameter of the circle through a, b, c, rounded up. It is infinite for points on a
// line.
double circle_diameter(const Point<2>& a, const Point<2>& b, const Point<2>& c);

}  // namespace pnpbs
