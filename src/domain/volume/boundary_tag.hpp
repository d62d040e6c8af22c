// SPDX-License-Identifier: BSD-3-Clause
// Which surface a triangle between nodes on features stands for.
#pragma once

#include <cstdint>
#include <span>

#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// Of a triangle that turns counter-clockwise as seen from outside, and the patches that all its
// corners lie on: the tag of what bounds the domain there. Of several patches, or if there is none,
// that of the facet nearest to the triangle's middle which does not face away: the other side of a
// thin plate may be nearer still.
std::int32_t boundary_tag(const VolumeDomain& domain, const FacetCorners<3>& triangle,
                          std::span<const std::int32_t> patches);

}  // namespace pnpbs
