// SPDX-License-Identifier: BSD-3-Clause
// The shortest way between two points of a sphere, which is a part of a great circle.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// Of the directions of two points, in radians.
double angle_between(const Point<3>& a, const Point<3>& b);

// Of the direction of a point with the nearest one on the way from a to b, in radians. Not for
// opposite ends.
double angle_to_way(const Point<3>& x, const Point<3>& a, const Point<3>& b);

// Points between the two ends, in the chart: so many that the straight way from one to the next
// leaves the great circle nowhere at more than 0.3 degrees. Not for opposite ends, nor for a way
// through the point that is projected from.
std::vector<Point<2>> points_on_the_way(const StereographicChart& chart, const Point<3>& a,
                                        const Point<3>& b);

}  // namespace pnpbs
