// SPDX-License-Identifier: BSD-3-Clause
// Where the surfaces look at a node.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Unit: of the facet that node i lies on, or the mean of those on the sides of its feature; 0 where
// there is no surface, or where these look against each other.
Point<3> node_normal(const Level<3>& level, std::int64_t i);

}  // namespace pnpbs
