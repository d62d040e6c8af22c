// SPDX-License-Identifier: BSD-3-Clause
// Does the boundary of the tetrahedra follow the surfaces? Where d does not resolve the shape,
// triangles of the surface are missing from it: two sheets are closer than d, or an edge is sharp.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

template <int Dim>
struct Level;

struct SurfaceFit {
  // Triangles of the surfaces that are no faces of the tetrahedra's boundary, and faces of that
  // which are none of the surfaces.
  std::int64_t missing_faces = 0;
  Point<3> missing_at{};         // a node of one of them
  std::vector<Point<3>> places;  // this rank's nodes of them
};

// Of the surfaces that bound the domain, over all ranks, by the stars and lists there are. Of two
// triangles whose nodes lie on a circle, nearly, either diagonal will do. Collective.
SurfaceFit measure_surface_fit(const Level<3>& level);

}  // namespace pnpbs
