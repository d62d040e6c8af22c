// SPDX-License-Identifier: BSD-3-Clause
// The surface on the other side of a thin wall or of a narrow gap.
#pragma once

#include <optional>

#include "domain/volume/surface.hpp"
#include "geometry/volume/surface_index.hpp"

namespace pnpbs {

// Which way to look from a facet: where its normal points, or the other way.
enum class SideOfFacet { front, back };

// The point of the surfaces that lies straight before or behind a point of them, if it is nearer
// than `reach` and the two facets are parallel to within 25 degrees. Local.
std::optional<SurfacePoint> opposite_side(const Surface& surface, const SurfaceIndex& index,
                                          const SurfacePoint& at, SideOfFacet side, double reach);

}  // namespace pnpbs
