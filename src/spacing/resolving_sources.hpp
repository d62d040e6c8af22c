// SPDX-License-Identifier: BSD-3-Clause
// Points at which d is reduced to resolve the shape of a body: in thin walls, in narrow gaps, and
// where the sides of an edge are too close to each other.
#pragma once

#include <functional>
#include <vector>

#include "domain/node_limit.hpp"
#include "domain/volume/volume_domain.hpp"
#include "method/constants.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// The required resolution: layers of d across a wall and across a gap, and the smallest share of d
// to which d is reduced, however thin they are.
struct Resolution {
  double in_wall, in_gap, least;
};
inline constexpr Resolution kResolved{method::kLayersInWall, method::kLayersInGap, 0};

// Returns the points on the surfaces where d must be reduced, with the reduced d. `domain` must be
// checked, and all ranks evaluate `raw` at the same points. The references are not stored. Calls
// beat() repeatedly. Throws Error(ErrorKind::spacing) if the surfaces require more nodes than the
// limit allows.
// Collective.
std::vector<GrowthSource<3>> resolving_sources(
    const Spacing<3>& raw, const VolumeDomain& domain, const NodeLimit& limit,
    const Resolution& resolution, const std::function<void()>& beat = [] {});

}  // namespace pnpbs
