// SPDX-License-Identifier: BSD-3-Clause
// Determines the tag of boundary triangles whose corners lie on features.
#pragma once

#include <cstdint>
#include <span>

#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// Returns the tag of the boundary under a triangle that is counter-clockwise as seen from outside.
// `patches` are those on which all its corners lie. If there is exactly one, the nearest facet of
// that patch determines the tag. Otherwise the facet nearest to the centroid that does not face
// away does, since the other side of a thin plate may be nearer.
std::int32_t boundary_tag(const VolumeDomain& domain, const FacetCorners<3>& triangle,
                          std::span<const std::int32_t> patches);

}  // namespace pnpbs
