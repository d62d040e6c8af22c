// SPDX-License-Identifier: BSD-3-Clause
// A sweep over straight edges from low to high vertices. It finds pairs of edges that intersect in
// a point other than a common end, and the edge on the left of each vertex. All decisions are
// exact.
//
// Low and high are ordered by y, then by x, as in a plane that is rotated by an infinitesimal
// angle, so that no edge is horizontal. Left is towards smaller x. The method is that of M. I.
// Shamos and D. Hoey, "Geometric intersection problems" (1976). It compares edges only when they
// become neighbours along the sweep line, and needs O(n log n) time for any arrangement of edges.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

using VertexPair = std::array<std::int32_t, 2>;

// Returns whether a is below b.
inline bool is_lower(const Point<2>& a, const Point<2>& b) {
  return a[1] < b[1] || (a[1] == b[1] && a[0] < b[0]);
}

struct SweepConflict {
  std::int32_t edge;
  std::int32_t other;   // Edge that crosses, touches or overlaps `edge`; or -1.
  std::int32_t vertex;  // If `other` is -1, the vertex that lies inside `edge`.
};

struct SweepResult {
  // The next edge on the left of each vertex, or -1. Edges that end in the vertex are not
  // considered. It is valid only without conflicts.
  std::vector<std::int32_t> left_edge;
  // Of two edges that intersect, one is removed from the sweep, so the list is not complete. It is
  // empty only if there are no conflicts. To find all, resolve the listed ones and sweep again.
  std::vector<SweepConflict> conflicts;
  std::vector<VertexPair> coincident;  // Pairs of vertices at the same point.
};

// Runs the sweep. Vertices without edges are included as isolated points. The ends of an edge must
// differ.
SweepResult sweep_plane(const std::vector<Point<2>>& vertices,
                        const std::vector<VertexPair>& edges);

}  // namespace pnpbs
