// SPDX-License-Identifier: BSD-3-Clause
// The star of a node at or near the boundary, or with a gap beside it: gift wrapping around the
// node. After neighbour a comes the visible node b to the left of the way to a whose circle
// through the node, a and b holds no other visible one. Boundary edges are edges of the
// triangulation whatever lies in their circles.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/delaunay_stars.hpp"

namespace pnpbs {

// Appends the star of node i to `star`, looking as far as needed, and returns 0. Where it would
// have to look farther than this rank knows the nodes, it appends nothing and returns how far (see
// DelaunayStars::needs).
// The list of the node holds all that it sees within listed_reach (0 if that is not sure), and is
// tried first.
double constrained_star(const StarInput& input, std::int64_t i, double listed_reach,
                        double first_reach, std::vector<DelaunayStars::Entry>& star);

}  // namespace pnpbs
