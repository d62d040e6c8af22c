// SPDX-License-Identifier: BSD-3-Clause
// Nodes that keep the boundary of the tetrahedra from closing. In a notch, or in a gap or wall
// narrower than d, an inner node may reach across one sheet of the surface to the next. Tetrahedra
// with this corner are elements, whatever lies between the sheets. Without the node there are
// tetrahedra between surface nodes alone, whose labels can be chosen so that the boundary closes
// (settled_elements.hpp).
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Removes blocking nodes, using the present stars with settled elements.
// It counts inner nodes on the boundary, surface nodes without their disks, and nodes of surplus
// pieces of the boundary. If the number is smaller than nodes_off_before, it removes the inner
// nodes on the boundary and those that share an element with another counted node. A surface node
// that is surrounded by elements without inner nodes is removed itself. Feature nodes are kept. If
// none of these helps, it removes the nodes of loose pieces, or lone nodes (loose_pieces.hpp).
// Afterwards there are lists but no stars. Returns the number of removed nodes over all ranks. All
// ranks must call it, and if one rank throws, all ranks throw.
std::int64_t remove_blocking_nodes(Level<3>& level, std::int64_t& nodes_off_before);

}  // namespace pnpbs
