// SPDX-License-Identifier: BSD-3-Clause
// Euler's characteristic, vertices less edges plus triangles, of the boundary of the tetrahedra and
// of the surfaces that it stands for. Where nothing is torn they differ by 2 for each handle or
// hole, and each piece.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Of the faces that have a tetrahedron on one side only, by the stars of the owned nodes.
// Collective.
std::int64_t euler_of_boundary(const Level<3>& level);

// Of the domain's surfaces, but for inner ones. Local.
std::int64_t euler_of_surfaces(const Level<3>& level);

}  // namespace pnpbs
