// SPDX-License-Identifier: BSD-3-Clause
// The position of a new bubble (section 2.4 of the paper): in the largest hole beside a bubble
// whose overlap ratio is small.
#pragma once

#include <cstdint>
#include <vector>

#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// Returns a position for a new bubble beside a bubble at x with spacing d. `around` has the
// positions of the neighbours. If the largest hole has a radius of at most d, the result is its
// centre. Otherwise it is the point at distance d from x that lies away from the neighbours.
template <int Dim>
Point<Dim> free_place(const Point<Dim>& x, double d, const std::vector<Point<Dim>>& around);

// Returns the same position beside node i, whose neighbours are those of its adjacency list.
template <int Dim>
Point<Dim> free_place(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  std::vector<Point<Dim>> around;
  lists.for_neighbours(i, [&](std::int64_t j) { around.push_back(nodes.position(j)); });
  return free_place<Dim>(nodes.position(i), nodes.d(i), around);
}

}  // namespace pnpbs
