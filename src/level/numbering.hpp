// SPDX-License-Identifier: BSD-3-Clause
// How nodes on their way into a level are sorted, numbered and stored.
#pragma once

#include <cstdint>
#include <vector>

#include "initial/given_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Of inner nodes; a boundary node has none, it is laid afresh.
void find_leaves(const Level& level, GivenNodes& given);
// By leaf, in Morton order, and by place within it, so that nothing depends on where nodes came
// from; those that have no leaf are left out. Returns the first place of each leaf.
std::vector<std::int32_t> sort_by_place(const Level& level, GivenNodes& given);
// The boundary nodes of this rank and these, sorted by place, become the nodes of the level. Those
// without an id get new ones; `boundary_ids` are those that boundary nodes keep, -1 for none; if
// empty, all are new. Collective.
void number_and_store(Level& level, GivenNodes inner, std::vector<std::int64_t> boundary_ids);

}  // namespace pnpbs
