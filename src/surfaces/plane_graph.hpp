// SPDX-License-Identifier: BSD-3-Clause
// Splits segments in a plane where they meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/exact_points.hpp"

namespace pnpbs {

// Points and edges in a plane. Edges meet only in common points, and no point lies on another edge.
struct PlaneGraph {
  std::vector<std::int32_t> points;                // in the lexicographic order of the projection
  std::vector<std::array<std::int32_t, 2>> edges;  // by index in `points`, the lower one first
};

// Splits segments of one plane at their intersections and at all points. A segment with equal ends
// is a point. `k` is an axis that is not parallel to the plane. Takes O(n log n) time if segments
// have few neighbours.
PlaneGraph split_segments(ExactPoints& points, int k,
                          std::vector<std::array<std::int32_t, 2>> segments);

}  // namespace pnpbs
