// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists of ghosts. A rank has many thousands of ghosts but needs few of their lists,
// so these are built on request.
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Returns the nodes whose lists are built before stars are found. In bodies the stars of ghosts are
// received, so only owned nodes need lists.
ListsOf lists_of_stars(const Level<2>& level);
ListsOf lists_of_stars(const Level<3>& level);

// Adds the lists of these nodes and of all nodes within this many hops of them, as far as they are
// missing.
template <int Dim>
void add_lists_around(Level<Dim>& level, const std::vector<std::int32_t>& nodes, int rings);

}  // namespace pnpbs
