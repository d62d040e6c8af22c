// SPDX-License-Identifier: BSD-3-Clause
// Edges at which a body itself is sharp: two of its triangles meet there, with less than 33 degrees
// of the body between them, and no tetrahedron at the edge can have larger angles.
#pragma once

#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"
#include "geometry/volume/nearest_triangles.hpp"

namespace pnpbs {

class SharpEdges {
 public:
  SharpEdges(const BoundaryMesh<3>& mesh, const Features& features);

  bool none() const { return edges_.triangles().empty(); }
  // Is one of them nearer than that?
  bool any_nearer(const Point<3>& x, double distance) const {
    return edges_.nearest(x).square < distance * distance;
  }

 private:
  NearestTriangles edges_;  // each with its end twice
};

}  // namespace pnpbs
