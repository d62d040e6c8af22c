// SPDX-License-Identifier: BSD-3-Clause
// The nodes that close a whole sphere, from a placement of their own in a disc. The function is
// defined in the folder placement, which is above this one, because a placement can only be made
// there.
#pragma once

#include <vector>

#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// Returns the nodes of a disc around the point opposite to the projection point of the chart, as
// points of the sphere. `radius` is in radians. The three corners of the triangle at the centre of
// the disc come first. Every rank places the same nodes on its own. Local.
std::vector<Point<3>> nodes_around(const StereographicChart& other, const Spacing<2>& spacing,
                                   double radius);

}  // namespace pnpbs
