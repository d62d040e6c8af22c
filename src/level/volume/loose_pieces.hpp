// SPDX-License-Identifier: BSD-3-Clause
// Parts of the surfaces that no elements can represent. Where corners of the surfaces are much
// closer to each other than d, as where two cuts of a body nearly meet, the tetrahedra between them
// may be disconnected from the others, or the closed end of a notch may be a bubble in the body: a
// surplus piece of the boundary. At the tip of a needle or the edge of a blade that is sharper than
// any tetrahedron, nodes have no elements, however small d is.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"
#include "level/volume/boundary_pieces.hpp"

namespace pnpbs {

// Returns the surplus pieces: as many as there are more pieces than the surfaces have, those with
// the fewest nodes.
std::set<std::int64_t> surplus_pieces(const Level<3>& level, const BoundaryPieces& pieces);

// Returns the ids of the nodes of surplus pieces smaller than half of d, ascending and the same on
// all ranks. The caller removes them; feature nodes among them are added to level.left_out. d does
// not resolve what is lost. Pieces with a fixed node of the user are kept. Requires stars with
// settled elements. All ranks must call it, and if one rank throws, all ranks throw.
std::vector<std::int64_t> ids_of_loose_pieces(Level<3>& level);

// Returns the ids of the nodes on surfaces that bound the domain which are no corner of an element
// but are beside a node with elements, ascending and the same on all ranks. There are none until d
// has been reduced in two rounds. The caller removes them; feature nodes among them are added to
// level.left_out. Fixed nodes of the user are kept. Requires stars with settled elements. All ranks
// must call it, and if one rank throws, all ranks throw.
std::vector<std::int64_t> ids_of_lone_nodes(Level<3>& level);

// Returns the number of nodes of corners and feature edges that were left out, and the position of
// one. Collective.
FoundNodes<3> features_left_out(const Level<3>& level);

}  // namespace pnpbs
