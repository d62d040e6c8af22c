// SPDX-License-Identifier: BSD-3-Clause
// Edges of the triangles on surfaces alone, with the triangles that meet at them.
#pragma once

#include <cstdint>
#include <functional>

#include "results/results.hpp"

namespace pnpbs {

// An edge and the number of its triangles.
struct SurfaceEdge {
  std::int64_t low = 0, high = 0;        // ids of its ends
  std::int64_t triangles = 0, left = 0;  // all triangles, and those on its left from low to high
  std::int64_t sheets = 0;               // sheets that meet at its feature edge; 0 if it has none
  Point<3> at{};                         // position of the node `low`
};

// Returns the number of sheets that meet at the feature curve on which nodes i and j are adjacent,
// or 0 if none exists.
std::int64_t sheets_at(const Results<3>& results, std::int64_t i, std::int64_t j);

// Calls visit(edge) for the edges whose number of triangles is wrong, on one rank each. An edge of
// a feature must have one for each sheet, and any other edge two, one on either side. Requires
// prepare_stars(). Collective.
void for_unmatched_edges(const Results<3>& results,
                         const std::function<void(const SurfaceEdge&)>& visit);

}  // namespace pnpbs
