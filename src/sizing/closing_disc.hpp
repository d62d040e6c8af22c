// SPDX-License-Identifier: BSD-3-Clause
// The nodes that close a whole sphere come from a placement of their own in a disc. The function is
// defined in the folder placement, which stands above this one: only there a placement can be made.
#pragma once

#include <vector>

#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// The nodes of a disc of that radius, in radians, around the point opposite to the one that the
// chart is projected from, as points of the sphere. The three corners of the triangle next to the
// middle of the disc come first. Every rank places them for itself. Local.
std::vector<Point<3>> nodes_around(const StereographicChart& other, const Spacing<2>& spacing,
                                   double radius);

}  // namespace pnpbs
