// SPDX-License-Identifier: BSD-3-Clause
// Of how many pieces the boundary of the tetrahedra is, and the surfaces that it stands for: faces
// with a common node are of one.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Each piece goes by the least id of its nodes.
struct BoundaryPieces {
  std::vector<std::int64_t> of;                // of this rank's nodes, -1: no face of an owned node
  std::map<std::int64_t, std::int64_t> nodes;  // how many each has, of all ranks
};

// By the stars of the owned nodes and the ghosts around them. Collective.
BoundaryPieces boundary_pieces(const Level<3>& level);
// How many there are. Collective.
std::int64_t pieces_of_boundary(const Level<3>& level);

// Inner surfaces do not count. Local.
std::int64_t pieces_of_surfaces(const Level<3>& level);

}  // namespace pnpbs
