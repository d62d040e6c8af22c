// SPDX-License-Identifier: BSD-3-Clause
// The boundary of the tetrahedra, as one of its nodes sees it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Triangles around a node: the other two corners of each, counter-clockwise as seen from outside.
using FaceSide = std::pair<std::int32_t, std::int32_t>;
using FaceFan = std::vector<FaceSide>;  // sorted

bool has_side(const FaceFan& fan, std::int32_t from, std::int32_t to);

// The faces at node i that have a tetrahedron on one side only.
FaceFan open_faces(const Level<3>& level, std::int64_t i);

// How many disks these faces make around their node, each face joined to the next one; 0 if they do
// not, or there are none.
std::int64_t disks_of(const FaceFan& fan);

}  // namespace pnpbs
