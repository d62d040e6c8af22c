// SPDX-License-Identifier: BSD-3-Clause
// Checks of the guarantees that the interface gives for the results of a placement. They apply to
// what callers get: nodes, lists and stars, over all ranks.
#pragma once

#include <optional>

#include "base/message_text.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Checks the results of a plane domain or of a sphere. Returns a message if elements are missing,
// so that they do not fill the domain (conformity.hpp). Throws Error(ErrorKind::internal) with a
// message and the nodes unless all of these hold:
// - ids are unique, no two nodes coincide, each node lies inside or is a boundary node, and all
//   boundary nodes are there,
// - node i is in the list of node j if j is in the list of i,
// - stars are counter-clockwise, each triangle is in the stars of its three corners, and each edge
//   has triangles on both sides, or on its inner sides only if it is a boundary edge, so the
//   triangles are one conforming triangulation that has all boundary edges,
// - the areas of the triangles sum up to that of the domain.
// Each rank uses only its own nodes and ghosts. Collective.
std::optional<MessageText> check_results(Results<2>& results);
// Checks the results of a domain in space likewise. For bodies these conditions must hold:
// - ids and positions as above, each node lies inside, on a surface, or where it was placed on a
//   feature, and all feature nodes are there,
// - lists as above,
// - each tetrahedron has a positive volume and is in the stars of its four corners, a face has at
//   most one tetrahedron on each side, and a face of inner nodes has one on both sides,
// - the faces with one tetrahedron form closed surfaces, which enclose the volume of the
//   tetrahedra and that of the domain up to the volume that faces may cut off.
// Collective.
std::optional<MessageText> check_results(Results<3>& results);
// Checks the results on surfaces alone. `fills` is the result of
// Conformity::fills(). These conditions
// must hold:
// - ids, positions, nodes and lists as above,
// - each triangle is in the stars of its three corners,
// - if they conform, the areas of the triangles sum up to that of the surfaces, up to the area that
//   may lie between both.
// Requires prepare_stars(). Collective.
void check_surfaces(const Results<3>& results, bool fills);

}  // namespace pnpbs
