// SPDX-License-Identifier: BSD-3-Clause
// Finds the opposite surface across a thin wall or a narrow gap.
#pragma once

#include <optional>

#include "domain/volume/surface.hpp"
#include "geometry/volume/surface_index.hpp"

namespace pnpbs {

// The side of a facet: front is where its normal points.
enum class SideOfFacet { front, back };

// Returns the point where the normal line through `at` first meets the surfaces on the given side.
// Returns nothing if it is farther than `reach` or if the two facets differ by more than about 25
// degrees from parallel. Local.
std::optional<SurfacePoint> opposite_side(const Surface& surface, const SurfaceIndex& index,
                                          const SurfacePoint& at, SideOfFacet side, double reach);

}  // namespace pnpbs
