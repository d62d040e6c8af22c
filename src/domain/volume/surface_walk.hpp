// SPDX-License-Identifier: BSD-3-Clause
// Moves points along a surface from facet to facet, within the patch in which they begin.
#pragma once

#include <cstdint>

#include "domain/volume/surface.hpp"

namespace pnpbs {

// Returns the end of a straight path on the surface. Its length is that of the part of `move`
// tangential to the facet; it stops at a feature. The path is unfolded at edges between facets.
SurfacePoint walk(const Surface& surface, const SurfacePoint& from, const Point<3>& move);

// Returns the point of the surface nearest to x that descent from the given facet reaches.
SurfacePoint pull_back(const Surface& surface, const Point<3>& x, std::int32_t facet);

}  // namespace pnpbs
