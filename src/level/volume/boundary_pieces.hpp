// SPDX-License-Identifier: BSD-3-Clause
// The connected pieces of the boundary of the tetrahedra and of the surfaces that it represents.
// Faces with a common node belong to the same piece.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// The pieces of the boundary, each identified by the smallest id of its nodes.
struct BoundaryPieces {
  // Piece of each node of this rank; -1: no face in common with an owned node.
  std::vector<std::int64_t> of;
  std::map<std::int64_t, std::int64_t> nodes;  // number of nodes of each piece, over all ranks
};

// Finds the pieces from the stars of the owned nodes. All ranks must call it, and if one rank
// throws, all ranks throw.
BoundaryPieces boundary_pieces(const Level<3>& level);
// Returns their number. All ranks must call it, and if one rank throws, all ranks throw.
std::int64_t pieces_of_boundary(const Level<3>& level);

// Returns the number of pieces of the domain's surfaces, without inner ones. Local.
std::int64_t pieces_of_surfaces(const Level<3>& level);

}  // namespace pnpbs
