// SPDX-License-Identifier: BSD-3-Clause
// The faces into which edges that do not cross divide the plane.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// A side of an edge, seen from its begin to its end: 2 edge (left) or 2 edge + 1 (right); or, one
// past the sides of all edges, the unbounded outside of everything.
using Side = std::int64_t;

inline Side left_side(std::int32_t edge) { return 2 * static_cast<Side>(edge); }
inline Side right_side(std::int32_t edge) { return 2 * static_cast<Side>(edge) + 1; }

// Tells all pairs of sides that see each other across a vertex: those of edges next to each
// other around it, and, where no edge leads down, that of the edge on its left. Together they
// make the faces.
void for_each_contact(
    const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
    const SweepResult& sweep,
    const std::function<void(std::int32_t vertex, Side side, Side other)>& contact);

// The side that the left neighbour of a vertex shows to it.
Side side_left_of(std::int32_t vertex, const std::vector<Point<2>>& vertices,
                  const std::vector<VertexPair>& edges, const SweepResult& sweep);

struct Faces {
  std::int32_t count = 1;             // face 0 is the unbounded one
  std::vector<std::int32_t> of_side;  // of each Side
};

// `sweep` must be free of conflicts.
Faces find_faces(const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
                 const SweepResult& sweep);

}  // namespace pnpbs
