// SPDX-License-Identifier: BSD-3-Clause
// Ways on a surface, from facet to facet, that never leave the patch they begin in.
#pragma once

#include <cstdint>

#include "domain/volume/surface.hpp"

namespace pnpbs {

// Where one comes to who goes straight ahead on the surface: as far as the part of `move` along the
// facet is long, or up to a feature. At an edge between facets the way is unfolded.
SurfacePoint walk(const Surface& surface, const SurfacePoint& from, const Point<3>& move);

// The point of the surface that is nearest to x among those around, found downhill from a facet.
SurfacePoint pull_back(const Surface& surface, const Point<3>& x, std::int32_t facet);

}  // namespace pnpbs
