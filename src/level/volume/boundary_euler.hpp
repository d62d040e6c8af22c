// SPDX-License-Identifier: BSD-3-Clause
// Euler's characteristic, vertices minus edges plus triangles, of the boundary of the tetrahedra
// and of the surfaces that it represents. If nothing is torn, each handle, hole or piece in one and
// not the other makes a difference of 2.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Returns that of the faces with a tetrahedron on one side only, from the stars of the owned nodes.
// All ranks must call it, and if one rank throws, all ranks throw.
std::int64_t euler_of_boundary(const Level<3>& level);

// Returns that of the surfaces of the domain, without inner ones. Local.
std::int64_t euler_of_surfaces(const Level<3>& level);

}  // namespace pnpbs
