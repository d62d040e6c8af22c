// SPDX-License-Identifier: BSD-3-Clause
// The faces of the boundary of the tetrahedra around a node.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// The triangles around a node: the other two corners of each, counter-clockwise as seen from
// outside.
using FaceSide = std::pair<std::int32_t, std::int32_t>;
using FaceFan = std::vector<FaceSide>;  // sorted

// Returns whether the sorted fan has this side.
bool has_side(const FaceFan& fan, std::int32_t from, std::int32_t to);

// Returns the faces at node i that have a tetrahedron on one side only.
FaceFan open_faces(const Level<3>& level, std::int64_t i);

// Returns the number of disks that these faces form around their node. It is 0 if they do not form
// disks, or if none exist.
std::int64_t disks_of(const FaceFan& fan);

}  // namespace pnpbs
