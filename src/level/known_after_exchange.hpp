// SPDX-License-Identifier: BSD-3-Clause
// The region in which a rank knows all nodes.
#pragma once

#include "level/level.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// Returns the region after an exchange of this depth: the leaves that the rank owns, those of which
// it has ghosts, and those without nodes.
template <int Dim>
KnownRegion<Dim> known_after_exchange(Level<Dim>& level, int hops);

}  // namespace pnpbs
