// SPDX-License-Identifier: BSD-3-Clause
// A sweep over straight edges, from low to high: finds edges that meet other than in a common
// end, and tells what lies next to each vertex on its left. All decisions are exact.
//
// Low and high: by y, then by x (a plane turned by an infinitely small angle, in which no edge
// is horizontal). Left: towards smaller x. The method is that of M. I. Shamos and D. Hoey,
// "Geometric intersection problems" (1976), which looks at edges only when they become
// neighbours along the sweep line: O(n log n) however the edges lie.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

using VertexPair = std::array<std::int32_t, 2>;

// Is a below b?
inline bool is_lower(const Point<2>& a, const Point<2>& b) {
  return a[1] < b[1] || (a[1] == b[1] && a[0] < b[0]);
}

struct SweepConflict {
  std::int32_t edge;
  std::int32_t other;   // crosses, touches or overlaps `edge`; or -1
  std::int32_t vertex;  // if other is -1: lies inside `edge`
};

struct SweepResult {
  // Per vertex: the edge next to it on its left, or -1. Edges that end in the vertex do not
  // count. Meaningful if there are no conflicts.
  std::vector<std::int32_t> left_edge;
  // Of edges that meet, one takes no further part: all conflicts are found only by resolving
  // these and sweeping again, but none are reported only if there are none.
  std::vector<SweepConflict> conflicts;
  std::vector<VertexPair> coincident;  // vertices at the same place
};

// Vertices without edges take part as mere points. The ends of an edge must differ.
SweepResult sweep_plane(const std::vector<Point<2>>& vertices,
                        const std::vector<VertexPair>& edges);

}  // namespace pnpbs
