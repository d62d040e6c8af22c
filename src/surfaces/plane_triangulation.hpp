// SPDX-License-Identifier: BSD-3-Clause
// Constrained triangulation of exact points in a plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/exact_points.hpp"
#include "surfaces/plane_graph.hpp"

namespace pnpbs {

// Triangulates the convex hull of the points of a graph so that its edges are edges of triangles.
// `k` is an axis that is not parallel to the plane. The points may not all be on a line. Returns
// triangles by index in graph.points, counter-clockwise in the projection along k. They are
// constrained Delaunay triangles as far as the rounded positions allow; the triangles within a
// polygon of edges depend on its points only.
std::vector<std::array<std::int32_t, 3>> triangulate(const ExactPoints& points, int k,
                                                     const PlaneGraph& graph);

}  // namespace pnpbs
