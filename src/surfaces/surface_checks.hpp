// SPDX-License-Identifier: BSD-3-Clause
// Is the boundary closed, and does it have two sides everywhere?
#pragma once

#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

// In every edge of a boundary surface two of its triangles must meet. Throws
// Error(ErrorKind::domain) naming the first where it is otherwise.
void require_closed_boundary(const Triangulation& surface, const SurfaceEdges& edges);

// Warns of vertices in which boundary surfaces touch: where triangles around it are not all joined
// by edges.
void warn_of_touching_vertices(const Triangulation& surface, const SurfaceEdges& edges,
                               std::vector<Warning>& warnings);

}  // namespace pnpbs
