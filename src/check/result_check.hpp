// SPDX-License-Identifier: BSD-3-Clause
// Do the results of a placement keep what the interface promises of them? Asked of what is handed
// out: nodes, lists and stars, over all ranks.
#pragma once

#include <optional>

#include "base/message_text.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Returns what is wrong where elements are missing without which they cannot fill the domain
// (conformity.hpp). Throws Error(ErrorKind::internal), which says what is wrong and at which nodes,
// unless
// - ids are unique, no two nodes lie in one place, all lie inside or are nodes of the boundary,
//   and all of those are there,
// - node i is in the list of node j where j is in that of i,
// - stars go round counter-clockwise, each triangle is in the stars of its three corners, and each
//   edge has triangles on both sides, an edge of the boundary on its inner sides alone: so the
//   triangles are one conforming triangulation, which holds all edges of the boundary,
// - the triangles' areas add up to the domain's.
// No rank learns more than what its own nodes and ghosts are. Collective.
std::optional<MessageText> check_results(Results<2>& results);
// The same in space, unless
// - ids and places as there, all nodes lie inside, on a surface or where they were laid on the
//   features, and all of those are there,
// - lists as there,
// - tetrahedra are of positive volume, each in the stars of its four corners, and on either side of
//   a face there is one at most, of a face of inner nodes one on both sides,
// - the faces with a tetrahedron on one side only are closed surfaces, which enclose the volume of
//   the tetrahedra, and that of the domain but for what they may cut off.
// Collective.
std::optional<MessageText> check_results(Results<3>& results);
// The same of surfaces alone, unless
// - ids, places, nodes and lists as there,
// - each triangle is in the stars of its three corners,
// - if they conform, their areas add up to that of the surfaces, but for what lies between these
//   and them.
// After prepare_stars. Collective.
void check_surfaces(const Results<3>& results, bool fills);

}  // namespace pnpbs
