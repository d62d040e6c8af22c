// SPDX-License-Identifier: BSD-3-Clause
// Elements of second order: the edges that carry their mid nodes, and whether curved edges leave
// them usable.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/space_vectors.hpp"

namespace pnpbs {

// The edges of an edge, a triangle or a tetrahedron in the order of the mid nodes that VTK uses.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kElementEdges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

// Returns the number of edges of an element with so many corners.
constexpr std::size_t edges_of(std::size_t corners) { return corners * (corners - 1) / 2; }

// Returns the gradients of the barycentric coordinates; for triangles in space within their plane.
inline std::array<Point<3>, 3> barycentric_gradients(const std::array<Point<3>, 3>& x) {
  const Point<3> normal = cross(difference(x[1], x[0]), difference(x[2], x[0]));
  std::array<Point<3>, 3> gradients;
  for (std::size_t k = 0; k < 3; ++k)
    gradients[k] = shifted({}, 1 / dot(normal, normal),
                           cross(normal, difference(x[(k + 2) % 3], x[(k + 1) % 3])));
  return gradients;
}

inline std::array<Point<3>, 4> barycentric_gradients(const std::array<Point<3>, 4>& x) {
  std::array<Point<3>, 4> gradients;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point<3>& base = x[(k + 1) % 4];
    const Point<3> normal =
        cross(difference(x[(k + 2) % 4], base), difference(x[(k + 3) % 4], base));
    gradients[k] = shifted({}, 1 / dot(normal, difference(x[k], base)), normal);
  }
  return gradients;
}

// Returns whether the Jacobian of an element of second order is at least kLeastJacobian of that of
// the straight element everywhere. `ways` are the displacements of its mid nodes from the middles
// of its edges, in the order of kElementEdges. The bound grows with each displacement, so an
// element that satisfies it does so, too, if some of its edges are straight. The linear part of the
// Jacobian in the displacements is bounded at the corners, where it is largest, and the others by
// products of lengths.
template <std::size_t corners>
bool stays_unfolded(const std::array<Point<3>, corners>& x,
                    std::array<Point<3>, edges_of(corners)> ways) {
  constexpr double kLeastJacobian = 0.1;
  constexpr std::size_t kEdges = edges_of(corners);
  const auto gradients = barycentric_gradients(x);
  if constexpr (corners == 3) {  // Moving along the normal of its plane folds no triangle.
    const Point<3> normal = unit_vector(cross(difference(x[1], x[0]), difference(x[2], x[0])));
    for (Point<3>& way : ways) way = part_across(way, normal);
  }
  // Gradients of the shape functions of mid nodes, 4 times the product of the coordinates of the
  // ends: the largest length of each.
  std::array<double, kEdges> steepest;
  for (std::size_t e = 0; e < kEdges; ++e)
    steepest[e] = 4 * std::max(length(gradients[kElementEdges[e][0]]),
                               length(gradients[kElementEdges[e][1]]));
  double loss = 0;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    double at_corner = 0;
    for (std::size_t e = 0; e < kEdges; ++e) {
      const auto& [a, b] = kElementEdges[e];
      if (a != corner && b != corner) continue;
      at_corner += std::max(0.0, -4 * dot(ways[e], gradients[a == corner ? b : a]));
    }
    loss = std::max(loss, at_corner);
  }
  for (std::size_t e = 0; e < kEdges; ++e)
    for (std::size_t f = e + 1; f < kEdges; ++f) {
      const Point<3> area = cross(ways[e], ways[f]);
      loss += length(area) * steepest[e] * steepest[f];
      for (std::size_t g = f + 1; g < kEdges; ++g)
        loss += std::fabs(dot(area, ways[g])) * steepest[e] * steepest[f] * steepest[g];
    }
  return loss <= 1 - kLeastJacobian;  // false for NaN, of an element without volume
}

}  // namespace pnpbs
