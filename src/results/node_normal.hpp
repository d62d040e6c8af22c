// SPDX-License-Identifier: BSD-3-Clause
// Where the surfaces look at a node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Unit: of the facet that each of these nodes lies on, or the mean of those on the sides of its
// feature; 0 where there is no surface, or where these look against each other. On level sets, but
// for their corners, the gradient of f counts.
std::vector<Point<3>> node_normals(const Level<3>& level, std::span<const std::int64_t> nodes);

}  // namespace pnpbs
