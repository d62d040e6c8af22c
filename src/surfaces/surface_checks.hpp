// SPDX-License-Identifier: BSD-3-Clause
// Checks that boundary surfaces are closed and that triangles meet only in common vertices and
// edges.
#pragma once

#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::domain) at the first edge of a boundary surface that does not have
// exactly two boundary triangles.
void require_closed_boundary(const Triangulation& surface, const SurfaceEdges& edges);

// Warns of vertices at which boundary surfaces touch, that is, whose triangles are not all
// connected by edges.
void warn_of_touching_vertices(const Triangulation& surface, const SurfaceEdges& edges,
                               std::vector<Warning>& warnings);

// Returns a tree of the bounding boxes of all triangles.
BoxTree<3> tree_of(const Triangulation& surface);

// Throws Error(ErrorKind::domain) if triangles meet other than in common vertices and edges. The
// message lists the first pairs with their locations, and their number. `filled` is false for
// surfaces alone. Takes O(n log n) time if triangles have few neighbours.
void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree, bool filled = true);

}  // namespace pnpbs
