// SPDX-License-Identifier: BSD-3-Clause
// Bounding box, volume and area of a domain.
#pragma once

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

struct VolumeExtent {
  Box<3> bounds;
  double volume;
  double area;  // of what bounds it, and of surfaces alone
};

// Of a mesh whose triangles know their sides; summed in their order, with the rounding's error
// kept.
VolumeExtent extent_of(const BoundaryMesh<3>& mesh);

}  // namespace pnpbs
