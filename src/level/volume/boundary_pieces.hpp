// SPDX-License-Identifier: BSD-3-Clause
// Of how many pieces the boundary of the tetrahedra is, and the surfaces that it stands for: faces
// with a common node are of one.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// By the stars of the owned nodes and the ghosts around them. Collective.
std::int64_t pieces_of_boundary(const Level<3>& level);

// Inner surfaces do not count. Local.
std::int64_t pieces_of_surfaces(const Level<3>& level);

}  // namespace pnpbs
