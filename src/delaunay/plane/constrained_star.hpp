// SPDX-License-Identifier: BSD-3-Clause
// The star of a node near the boundary or next to a gap, found by gift wrapping around the node.
// The neighbour after a is the visible node b on the left of the line from the node to a such that
// the circle through the node, a and b contains no other visible node. Boundary edges are edges of
// the triangulation whatever their circles contain.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/delaunay_stars.hpp"

namespace pnpbs {

// Appends the star of node i to `star` and returns 0. The search extends as far as necessary. If it
// would have to extend beyond the nodes that this rank knows, nothing is appended and the necessary
// distance is returned (see DelaunayStars::needs).
// The list of the node must contain all nodes visible from it within `listed_reach`, and is tried
// first. `listed_reach` is 0 if that is not certain. Without success, all
// nodes within `first_reach` are searched, then those within larger distances.
double constrained_star(const StarInput& input, std::int64_t i, double listed_reach,
                        double first_reach, std::vector<DelaunayStars::Entry>& star);

}  // namespace pnpbs
