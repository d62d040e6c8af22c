// SPDX-License-Identifier: BSD-3-Clause
// Graphs that stand for smooth curves between their corners.
#pragma once

#include "domain/plane/curve_source.hpp"

namespace pnpbs {

// By how much the way turns at a point between two others, in degrees.
double turn_in_degrees(const Point<2>& before, const Point<2>& at, const Point<2>& after);

// Finds the corners of a graph: where the direction turns by more than corner_angle (degrees),
// where not two segments end or segments of different tags do, and vertices with a tag of their
// own; and puts its segments in order, chain by chain from corner to corner. 0: every vertex is a
// corner.
void find_corners(CurveSource& graph, double corner_angle);

}  // namespace pnpbs
