// SPDX-License-Identifier: BSD-3-Clause
// Points of the surface where d is too large for the body. If the elements of a run do not fill the
// domain there, usually two sheets of the surface are closer to each other than d, or the surface
// surrounds a bar or a hole that is narrower than d.
#pragma once

#include <vector>

#include "level/level.hpp"
#include "spacing/growth_source.hpp"

namespace pnpbs {

// Returns the narrow points within d of the points `near`, or all if `near` is empty, each with the
// d that is required there. `near` holds d as well. Returns nothing in the plane, where boundary
// nodes lie on their curves. Throws Error(ErrorKind::spacing) if there are more points than nodes
// allowed. The result is the same on all ranks.
// Collective.
std::vector<GrowthSource<2>> narrow_points(const Level<2>& level,
                                           const std::vector<GrowthSource<2>>& near);
std::vector<GrowthSource<3>> narrow_points(const Level<3>& level,
                                           const std::vector<GrowthSource<3>>& near);

}  // namespace pnpbs
