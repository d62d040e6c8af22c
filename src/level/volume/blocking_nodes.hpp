// SPDX-License-Identifier: BSD-3-Clause
// Nodes that keep the boundary of the tetrahedra from closing. In a notch, and in a gap or a wall
// narrower than d, a node from inside reaches across one sheet of the surface to the next: then
// tetrahedra that have it as a corner, whose labels say what lies between the sheets, can only be
// elements. Without it there are tetrahedra between nodes of the surface alone, among which a
// closed boundary is found (settled_elements.hpp).
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Of the stars that there are, with their elements settled: counts the nodes that are on the
// boundary but from inside, on a surface without its disks around them, or on a piece of the
// boundary too many. If they are fewer than before, nodes from inside leave: those on the boundary,
// and those that an element joins to one of the others. A node of a surface with elements all
// around it, and none of them with a node from inside, leaves itself. Those of features stay.
// Leaves lists then, and no stars. Returns how many left, of all ranks. Collective.
std::int64_t remove_blocking_nodes(Level<3>& level, std::int64_t& nodes_off_before);

}  // namespace pnpbs
