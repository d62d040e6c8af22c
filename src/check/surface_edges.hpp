// SPDX-License-Identifier: BSD-3-Clause
// The edges of the triangles on surfaces alone, and the triangles that meet at each.
#pragma once

#include <cstdint>
#include <functional>

#include "results/results.hpp"

namespace pnpbs {

struct SurfaceEdge {
  std::int64_t low = 0, high = 0;        // ids
  std::int64_t triangles = 0, left = 0;  // at the edge, and on its left from low to high
  std::int64_t sheets = 0;               // of the surfaces that meet there; 0: no part of a feature
  Point<3> at{};                         // of the node `low`
};

// Of the feature curve on which nodes i and j are next to each other, the sheets that meet there; 0
// if there is none.
std::int64_t sheets_at(const Results<3>& results, std::int64_t i, std::int64_t j);

// Calls visit(edge) for the edges of triangles that have not one for each sheet; between features
// two, one on either side. Each on one of the ranks. After prepare_stars; collective.
void for_unmatched_edges(const Results<3>& results,
                         const std::function<void(const SurfaceEdge&)>& visit);

}  // namespace pnpbs
