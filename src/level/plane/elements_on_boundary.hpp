// SPDX-License-Identifier: BSD-3-Clause
// Elements with all nodes on the boundary of the domain. They have no degree of freedom where the
// boundary prescribes the values, and let no water through a channel that they fill.
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"
#include "population/population.hpp"

namespace pnpbs {

// Returns the number of elements with all nodes on curves that bound the domain, over all ranks.
// The stars must be valid for the owned nodes. Collective.
std::int64_t elements_on_boundary(const Level<2>& level);
inline std::int64_t elements_on_boundary(const Level<3>&) { return 0; }

// Returns nodes at the middles of the longest inner edges of these elements, each on the rank that
// owns the end with the smaller id. With them no element has all nodes on the boundary, because
// each Delaunay triangle that is new has a new node. Elements without an inner edge, where curves
// form a triangle, remain. The stars must be valid for the owned nodes. Local.
PopulationChange<2> nodes_in_elements_on_boundary(const Level<2>& level);

}  // namespace pnpbs
