// SPDX-License-Identifier: BSD-3-Clause
// Where d is held down so that it resolves the shape of a body: in thin walls, in narrow gaps, and
// where the sides of an edge are too near to each other.
#pragma once

#include <functional>
#include <vector>

#include "domain/node_limit.hpp"
#include "domain/volume/volume_domain.hpp"
#include "method/constants.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// What there is to be room for: layers of d in the thickness of a wall and in the width of a gap;
// and the part of d below which it is not held, however thin they are.
struct Resolution {
  double in_wall, in_gap, least;
};
inline constexpr Resolution kResolved{method::kLayersInWall, method::kLayersInGap, 0};

// The domain, checked, is looked at here alone. d is asked on the surfaces, at the same points on
// all ranks. Throws Error(ErrorKind::spacing) if they needed more nodes than the limit allows.
// Calls beat() again and again. Collective.
std::vector<GrowthSource<3>> resolving_sources(
    const Spacing<3>& raw, const VolumeDomain& domain, const NodeLimit& limit,
    const Resolution& resolution, const std::function<void()>& beat = [] {});

}  // namespace pnpbs
