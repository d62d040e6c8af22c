// SPDX-License-Identifier: BSD-3-Clause
// Where a new bubble comes (section 2.4 of the paper): into the free place beside a sparse one.
#pragma once

#include <cstdint>
#include <vector>

#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// Beside a bubble at x whose spacing is d, among its neighbours: the middle of the largest hole,
// or if there is none d away from x on the side away from them.
template <int Dim>
Point<Dim> free_place(const Point<Dim>& x, double d, const std::vector<Point<Dim>>& around);

// The same of node i among its listed neighbours.
template <int Dim>
Point<Dim> free_place(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  std::vector<Point<Dim>> around;
  lists.for_neighbours(i, [&](std::int64_t j) { around.push_back(nodes.position(j)); });
  return free_place<Dim>(nodes.position(i), nodes.d(i), around);
}

}  // namespace pnpbs
