// SPDX-License-Identifier: BSD-3-Clause
// The tag of a boundary facet of the tetrahedra, which is that of the surface it represents.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Returns the patches that all these nodes lie on, without repetition. There is at least one node.
std::vector<std::int32_t> common_patches(const Level<3>& level,
                                         std::span<const std::int64_t> nodes);

// Returns the tag of a triangle. `nodes` are its corners, counter-clockwise as seen from outside,
// the one with the smallest id first. If a corner lies inside a surface, its tag is used; if all
// lie on features, the patches that they have in common decide. The result is the same on every
// rank that has the nodes.
std::int32_t facet_tag(const Level<3>& level, const std::array<std::int64_t, 3>& nodes);

}  // namespace pnpbs
