// SPDX-License-Identifier: BSD-3-Clause
// Is the boundary closed, and does it have two sides everywhere?
#pragma once

#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// In every edge of a boundary surface two of its triangles must meet. Throws
// Error(ErrorKind::domain) naming the first where it is otherwise.
void require_closed_boundary(const Triangulation& surface, const SurfaceEdges& edges);

// Warns of vertices in which boundary surfaces touch: where triangles around it are not all joined
// by edges.
void warn_of_touching_vertices(const Triangulation& surface, const SurfaceEdges& edges,
                               std::vector<Warning>& warnings);

// Surfaces meet in common vertices and edges only.

// The boxes of all triangles.
BoxTree<3> tree_of(const Triangulation& surface);

// Throws Error(ErrorKind::domain) naming the first two triangles that meet elsewhere, the place,
// and how many such pairs there are. In n log n time as long as triangles have few neighbours.
void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree);

}  // namespace pnpbs
