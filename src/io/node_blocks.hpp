// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a placement as files hold them.
#pragma once

#include "core/placement.hpp"
#include "io/node_block.hpp"

namespace pnpbs::io {

// All nodes in the order of their ids, triangles and boundary edges in the order of their corners;
// a rank gets an equal part, wherever its own nodes are. The same whole for any number of ranks.
// Collective.
NodeBlock block_by_id(Placement& placement, bool elements);

// This rank's own nodes and triangles, with the ghosts that these need; numbered by itself.
// Collective.
NodeBlock own_piece(Placement& placement, bool elements);

}  // namespace pnpbs::io
