// SPDX-License-Identifier: BSD-3-Clause
// The faces into which edges that do not cross each other divide the plane.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// A side of an edge, seen from its begin to its end: 2 edge (left) or 2 edge + 1 (right). The
// number after the sides of all edges is the unbounded face.
using Side = std::int64_t;

inline Side left_side(std::int32_t edge) { return 2 * static_cast<Side>(edge); }
inline Side right_side(std::int32_t edge) { return 2 * static_cast<Side>(edge) + 1; }

// Calls contact(vertex, side, other) for pairs of sides that belong to the same face: those of
// edges that are adjacent around a vertex and, if no edge leads down from a vertex, its last side
// and that of the edge on its left. The union of all pairs gives the faces.
void for_each_contact(
    const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
    const SweepResult& sweep,
    const std::function<void(std::int32_t vertex, Side side, Side other)>& contact);

// Returns the side that faces a vertex of the edge on the left of the vertex. It is the unbounded
// face if there is no such edge.
Side side_left_of(std::int32_t vertex, const std::vector<Point<2>>& vertices,
                  const std::vector<VertexPair>& edges, const SweepResult& sweep);

struct Faces {
  std::int32_t count = 1;             // Face 0 is the unbounded one.
  std::vector<std::int32_t> of_side;  // Face of each Side.
};

// Returns the faces. `sweep` must not contain conflicts.
Faces find_faces(const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
                 const SweepResult& sweep);

}  // namespace pnpbs
