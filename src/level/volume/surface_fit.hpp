// SPDX-License-Identifier: BSD-3-Clause
// The fit of the boundary of the tetrahedra to the surfaces. Where d does not resolve the shape,
// boundary faces lie far from all surfaces: across a gap, over an edge, or in the body.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

template <int Dim>
struct Level;

// The boundary faces that do not follow the surfaces.
struct SurfaceFit {
  // Number of boundary faces with a point farther than d from the surfaces, over all ranks.
  std::int64_t faces_off = 0;
  Point<3> off_at{};             // position of a node of one of them
  std::vector<Point<3>> places;  // positions of this rank's nodes of them
};

// Measures the fit from the stars of a body. Returns zeros for other domains. All ranks must call
// it, and if one rank throws, all ranks throw.
SurfaceFit measure_surface_fit(const Level<3>& level);

}  // namespace pnpbs
