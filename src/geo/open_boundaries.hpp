// SPDX-License-Identifier: BSD-3-Clause
// Lines that follow the boundary of the domain, such as the open boundary of a sea. They are not
// curves of their own, but define the tag of a part of the boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "geo/outlines.hpp"

namespace pnpbs::geo {

// Gives the tags of such lines to the boundary and removes the lines from `curves`. A line follows
// a part of the boundary if each lies within `tolerance` of the other. The boundary keeps its
// shape. It is split at the ends of the line unless it has a vertex within `tolerance` of them; new
// vertices are appended to `points`. Returns the number of lines removed.
std::int64_t retag_open_boundaries(std::vector<Curve>& curves, std::vector<Point<2>>& points,
                                   double tolerance);

}  // namespace pnpbs::geo
