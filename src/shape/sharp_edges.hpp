// SPDX-License-Identifier: BSD-3-Clause
// Edges at which the body itself is sharp: two triangles enclose less than 33 degrees (kSharpEdge)
// of the body, so no tetrahedron there can have larger angles.
#pragma once

#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"
#include "geometry/volume/nearest_triangles.hpp"

namespace pnpbs {

// The sharp edges of a mesh, in an index for distance queries.
class SharpEdges {
 public:
  SharpEdges(const BoundaryMesh<3>& mesh, const Features& features);

  bool none() const { return edges_.triangles().empty(); }
  // Returns true if a sharp edge is nearer to x than `distance`.
  bool any_nearer(const Point<3>& x, double distance) const {
    return edges_.nearest(x).square < distance * distance;
  }

 private:
  NearestTriangles edges_;  // edges as triangles (a, b, b)
};

}  // namespace pnpbs
