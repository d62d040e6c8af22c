// SPDX-License-Identifier: BSD-3-Clause
// Does the boundary of the tetrahedra follow the surfaces? Where d does not resolve the shape,
// faces of that boundary lie far from all surfaces: across a gap, over an edge, or in the body.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

template <int Dim>
struct Level;

struct SurfaceFit {
  // Boundary faces with a point farther than d from the surfaces, over all ranks.
  std::int64_t faces_off = 0;
  Point<3> off_at{};             // a node of one of them
  std::vector<Point<3>> places;  // this rank's nodes of them
};

// By the stars of a body. Collective.
SurfaceFit measure_surface_fit(const Level<3>& level);

}  // namespace pnpbs
