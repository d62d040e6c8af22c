// SPDX-License-Identifier: BSD-3-Clause
// What the elements cannot hold on to. Where corners of the surfaces lie much nearer to each other
// than d, as where two cuts of a body nearly meet, the tetrahedra between them may be a chip that
// holds on to nothing, or the bottom of a notch whose mouth is closed, a bubble: a piece of the
// boundary too many. And at the tip of a needle or the edge of a blade that is sharper than any
// tetrahedra, nodes are alone, however small d is.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"
#include "level/volume/boundary_pieces.hpp"

namespace pnpbs {

// Those beyond the number of the surfaces' pieces: the ones with the fewest nodes.
std::set<std::int64_t> pieces_too_many(const Level<3>& level, const BoundaryPieces& pieces);

// The ids of the nodes of those that are smaller than half of d, ascending, the same on all ranks;
// they are to leave, and those on features are counted as left out. What is lost is less than d
// resolves. A piece with a fixed node of the user's stays. By stars with settled elements.
// Collective.
std::vector<std::int64_t> ids_of_loose_pieces(Level<3>& level);

// The ids of the nodes on surfaces that bound the domain which no element has as a corner, next to
// nodes of elements, ascending, the same on all ranks: once d has been held down in two rounds they
// are to leave, and those on features are counted as left out. Fixed nodes of the user's stay. By
// stars with settled elements. Collective.
std::vector<std::int64_t> ids_of_lone_nodes(Level<3>& level);

// The nodes of corners and feature edges that were left out, and the place of one. Collective.
FoundNodes<3> features_left_out(const Level<3>& level);

}  // namespace pnpbs
