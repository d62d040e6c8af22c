// SPDX-License-Identifier: BSD-3-Clause
// Determines on which side of a surface a point lies, from the part of the surface nearest to it.
// This works where that part is closed and has the inside on one side only; the surface may be
// defective elsewhere. It is much cheaper than the winding number.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/volume/triangles.hpp"
#include "geometry/volume/winding_number.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

// The side of points near triangles that may enclose a body badly.
class SurfaceSides {
 public:
  // Neighbours must have the same orientation (orient_surfaces). `winding` must be that of the same
  // triangles.
  SurfaceSides(const Triangulation& surface, const SurfaceEdges& edges,
               const WindingNumber& winding);

  // Returns -1 if x is inside, 1 if it is outside, and 0 if this is not known. `nearest`, a point
  // of triangle t, must be the point of all triangles nearest to x. The sign is that of the normal
  // there; at edges and corners this is the mean of the normals around, weighted by their angles
  // (Baerentzen and Aanaes 2005).
  int side(std::int32_t t, const TrianglePoint& nearest, const Point<3>& x) const;

 private:
  void find_faces(const Triangulation& surface, const WindingNumber& winding);
  void leave_out_crossing(const Triangulation& surface);
  void find_edges(const SurfaceEdges& edges);
  void find_corners(const Triangulation& surface);

  // Outward normals of the triangles, of their edges from corner k to the next, and of their
  // corners. 0 means that the outside is not known.
  std::vector<Point<3>> face_;
  std::vector<std::array<Point<3>, 3>> edge_, corner_;
};

}  // namespace pnpbs
