// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists of ghosts. Of many thousands that a rank holds, few are asked for their
// lists: those are made when they are.
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Of which nodes lists are made before stars are found. In bodies a ghost has its list before its
// star is found.
ListsOf lists_of_stars(const Level<2>& level);
ListsOf lists_of_stars(const Level<3>& level);

// The lists of these nodes, too, if only those of owned nodes were made.
template <int Dim>
void add_lists_of(Level<Dim>& level, const std::vector<std::int32_t>& nodes);
// The lists of these nodes and of those within so many rings around them.
template <int Dim>
void add_lists_around(Level<Dim>& level, const std::vector<std::int32_t>& nodes, int rings);

}  // namespace pnpbs
