// SPDX-License-Identifier: BSD-3-Clause
// The normals of the surfaces at nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Returns a unit normal for each of these nodes: that of the facet it lies on, or the mean over the
// sides of its feature. It is 0 if the node lies on no surface or if the normals of the sides
// cancel. On level sets it is the gradient of f, except at their corners.
std::vector<Point<3>> node_normals(const Level<3>& level, std::span<const std::int64_t> nodes);

}  // namespace pnpbs
