// SPDX-License-Identifier: BSD-3-Clause
// Lines that run along what bounds the domain, as the open boundary of a sea does: they are no
// curves of their own, but tell the tag of that part of the boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "geo/outlines.hpp"

namespace pnpbs::geo {

// Of a line all of which lies within `tolerance` of a part of the boundary, and all of that part
// within `tolerance` of the line, that part has the tag and the line is gone. The boundary is split
// where the line begins and ends, unless it has a vertex within `tolerance` of there; it keeps its
// shape. New places are put behind `points`. The number of lines that were taken so.
std::int64_t retag_open_boundaries(std::vector<Curve>& curves, std::vector<Point<2>>& points,
                                   double tolerance);

}  // namespace pnpbs::geo
