// SPDX-License-Identifier: BSD-3-Clause
// On which side of triangles that may enclose a body badly a point is, where its nearest
// surroundings tell: where these are whole, and have the inside on one side of them alone. To know
// it there is much cheaper than the winding number.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/volume/triangles.hpp"
#include "geometry/volume/winding_number.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

class SurfaceSides {
 public:
  // Neighbours turn the same way (orient_surfaces); `winding` is of the same triangles.
  SurfaceSides(const Triangulation& surface, const SurfaceEdges& edges,
               const WindingNumber& winding);

  // -1 inside, 1 outside, 0 unknown: of a point whose nearest one of all triangles is this point of
  // triangle t. By the normal there, of edges and corners the mean of those around, weighted by
  // their angles (Baerentzen and Aanaes 2005).
  int side(std::int32_t t, const TrianglePoint& nearest, const Point<3>& x) const;

 private:
  void find_faces(const Triangulation& surface, const WindingNumber& winding);
  void leave_out_crossing(const Triangulation& surface);
  void find_edges(const SurfaceEdges& edges);
  void find_corners(const Triangulation& surface);

  // Pointing out; 0 where it is not known what is out. Of each triangle, of its edges from corner k
  // to the next one, and of its corners.
  std::vector<Point<3>> face_;
  std::vector<std::array<Point<3>, 3>> edge_, corner_;
};

}  // namespace pnpbs
