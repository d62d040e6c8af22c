// SPDX-License-Identifier: BSD-3-Clause
// Nodes that come to those that a level in space has.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Inner ones or on surfaces; each rank gives those that lie in its part. Returns how many, of all
// ranks. Collective.
std::int64_t add_nodes(Level<3>& level, IncomingNodes<3> more);

}  // namespace pnpbs
