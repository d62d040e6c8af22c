// SPDX-License-Identifier: BSD-3-Clause
// What the first row of inner nodes changes in the number of nodes.
#pragma once

#include <cstdint>

#include "spacing/sized_tree.hpp"

namespace pnpbs {

// How many nodes more than d asks for it has: as many as the boundary has edges there, though d has
// grown from these to the row. Looks at so many edges.
double more_by_first_row(const SizedTree<2>& map, const SpacingEvaluator<2>& spacing,
                         std::int64_t max_edges);
inline double more_by_first_row(const SizedTree<3>&, const SpacingEvaluator<3>&, std::int64_t) {
  return 0;
}

}  // namespace pnpbs
