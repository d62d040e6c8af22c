// SPDX-License-Identifier: BSD-3-Clause
// Where d is held down so that it resolves the shape of a body: to half the thickness of a wall, to
// three quarters of a gap's width, and where the sides of an edge are too near to each other.
#pragma once

#include <vector>

#include "domain/node_limit.hpp"
#include "domain/volume/volume_domain.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// The domain, checked, is looked at here alone. d is asked on the surfaces, at the same points on
// all ranks. Throws Error(ErrorKind::spacing) if they needed more nodes than the limit allows.
// Collective.
std::vector<GrowthSource<3>> resolving_sources(const Spacing<3>& raw, const VolumeDomain& domain,
                                               const NodeLimit& limit);

}  // namespace pnpbs
