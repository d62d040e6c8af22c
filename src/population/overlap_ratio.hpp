// SPDX-License-Identifier: BSD-3-Clause
// The overlap ratio of a bubble, equation (3) of the paper:
//   alpha_i = (1 / r_i) sum_j (2 r_i + r_j - l_ij),   r = d / 2, l the distance,
// every term clamped at 0, so that pairs out of reach add exactly nothing. Ideal: 2 on a line,
// Lattice<Dim>::kIdealOverlap inside, where it is the number of neighbours.
#pragma once

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// What a bubble j at distance l adds to the sum of bubble i.
inline double overlap(double d_i, double d_j, double l) {
  const double term = d_i + 0.5 * d_j - l;
  return term > 0 ? term : 0.0;
}

template <int Dim>
double overlap_ratio(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  const Point<Dim> x = nodes.position(i);
  double sum = 0;
  lists.for_neighbours(i, [&](std::int64_t j) {
    sum += overlap(nodes.d(i), nodes.d(j), distance<Dim>(x, nodes.position(j)));
  });
  return sum / (0.5 * nodes.d(i));
}

}  // namespace pnpbs
