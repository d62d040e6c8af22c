// SPDX-License-Identifier: BSD-3-Clause
// Estimates the change of the number of nodes by the first row of inner nodes.
#pragma once

#include <cstdint>

#include "spacing/sized_tree.hpp"

namespace pnpbs {

// Returns how many nodes the first row has in excess of d. The row has as many nodes as the
// boundary has edges there, although d has grown between the boundary and the row. About
// `max_edges` edges are examined.
double first_row_excess(const SizedTree<2>& map, const SpacingEvaluator<2>& spacing,
                        std::int64_t max_edges);
inline double first_row_excess(const SizedTree<3>&, const SpacingEvaluator<3>&, std::int64_t) {
  return 0;
}

}  // namespace pnpbs
