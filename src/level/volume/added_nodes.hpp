// SPDX-License-Identifier: BSD-3-Clause
// The insertion of nodes into a level in space that already has nodes.
#pragma once

#include <cstdint>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Inserts inner or surface nodes. Each rank passes the ones in its own leaves. Returns their number
// over all ranks. All ranks must call it, and if one rank throws, all ranks throw.
std::int64_t add_nodes(Level<3>& level, IncomingNodes<3> more);

}  // namespace pnpbs
