// SPDX-License-Identifier: BSD-3-Clause
// Which overlap ratios are too small and which too large. Bubbles that press on each other equally
// everywhere rest at any density, and between the ratios at which a single bubble is clearly one
// too few or too many there is room for some per cent of d. So the distances of touching bubbles
// are taken over all ranks, by octaves of d; where their mean is not the one aimed at, the
// thresholds let as many bubbles act as are missing or too many: those with the smallest ratios
// insert, those with the largest go.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lattice.hpp"
#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "method/constants.hpp"
#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// The overlap ratio of a bubble, equation (3) of the paper:
//   alpha_i = (1 / r_i) sum_j (2 r_i + r_j - l_ij),   r = d / 2, l the distance,
// every term clamped at 0, so that pairs out of reach add exactly nothing. Ideal: 2 on a line,
// Lattice<Dim>::kIdealOverlap inside, where it is the number of neighbours.

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

struct PopulationRule {
  int dimension;        // of what the bubbles fill: area or volume
  double ideal;         // overlap ratio of a bubble among neighbours at its d
  double delete_above;  // overlap ratios: whatever the mean
  double insert_below;
  double mean_distance;  // of touching bubbles, in desired distances; 0: not aimed at
  // A new bubble comes no nearer to others than this many spacings.
  double min_gap = method::kMinGap;
  double min_gap_to_aim = method::kMinGapToAim;
};

// Above which overlap ratio a bubble of this d goes, and below which it gets company to bring the
// mean distance down.
struct PopulationThresholds {
  struct Pair {
    double insert_below, delete_above;
  };
  int first_octave = 0;
  std::vector<Pair> octaves;  // from that one on; beyond them the nearest one's

  explicit PopulationThresholds(const PopulationRule& rule) : octaves{{0, rule.delete_above}} {}
  const Pair& at(double d) const;
};

// Of the bubbles that move; 0 for others.
template <int Dim>
View<double> overlap_ratios(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists);

// An octave whose mean distance is off by no more than the tolerance is left alone. Collective.
template <int Dim>
PopulationThresholds choose_thresholds(const Communicator& comm, const Nodes<Dim>& nodes,
                                       const AdjacencyList<Dim>& lists, const View<double>& ratios,
                                       const PopulationRule& rule, double tolerance);

}  // namespace pnpbs
