// SPDX-License-Identifier: BSD-3-Clause
// The tag of a triangle of the tetrahedra's boundary: that of the surface there.
#pragma once

#include <array>
#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// nodes: the triangle's, counter-clockwise as seen from outside, that of the least id first. If one
// lies inside of a surface, it knows; if all are on its features, the patches tell that they have
// in common. The same on every rank that has the nodes.
std::int32_t facet_tag(const Level<3>& level, const std::array<std::int64_t, 3>& nodes);

}  // namespace pnpbs
