// SPDX-License-Identifier: BSD-3-Clause
// Shortest arcs between two points of a sphere, which are parts of great circles.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// Returns the angle between two directions in radians.
double angle_between(const Point<3>& a, const Point<3>& b);

// Returns the angle in radians between direction x and the nearest point of the arc from a to b.
// The ends of the arc must not be opposite.
double angle_to_arc(const Point<3>& x, const Point<3>& a, const Point<3>& b);

// Returns points in the chart between the ends of the arc from a to b, without the ends. They are
// so dense that the straight line from one to the next deviates from the great circle by at most
// 0.3 degrees in direction. The ends must not be opposite, and the arc must not contain the
// projection centre.
std::vector<Point<2>> points_on_arc(const StereographicChart& chart, const Point<3>& a,
                                    const Point<3>& b);

}  // namespace pnpbs
