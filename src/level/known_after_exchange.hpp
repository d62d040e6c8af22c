// SPDX-License-Identifier: BSD-3-Clause
// Where a rank knows all nodes.
#pragma once

#include "level/level.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// After an exchange that deep: in the leaves that it owns, those of which it has the ghosts, and
// those that have no nodes.
template <int Dim>
KnownRegion<Dim> known_after_exchange(Level<Dim>& level, int hops);

}  // namespace pnpbs
