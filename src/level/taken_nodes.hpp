// SPDX-License-Identifier: BSD-3-Clause
// Nodes that a level takes over, wherever they come from: sent to their owners, thinned where they
// are too dense, and numbered.
#pragma once

#include <cstdint>

#include "initial/given_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// What became of given nodes, on all ranks.
struct TakenNodes {
  std::int64_t left_out = 0;  // outside, or too close to the boundary
  std::int64_t thinned = 0;   // too dense for d
  std::int64_t numbered = 0;  // those that came without an id
};

// Ids from next_id on are free. Collective.
TakenNodes take(Level& level, GivenNodes given, std::int64_t next_id);

}  // namespace pnpbs
