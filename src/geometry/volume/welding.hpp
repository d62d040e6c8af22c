// SPDX-License-Identifier: BSD-3-Clause
// Merges points that coincide within a tolerance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Returns for each point the index of the point that it is merged into. This is the nearest
// preceding point within the tolerance that is not merged itself, or the point itself if there is
// none. Points at exactly the same position are merged into the same point. The time is O(n log n)
// if not too many of them lie within a thousand tolerances of each other.
std::vector<std::int32_t> weld_points(std::span<const Point<3>> points, double tolerance);

}  // namespace pnpbs
