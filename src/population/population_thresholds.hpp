// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the overlap ratio for population control. Equally squeezed bubbles rest at any
// density: between the ratios at which a single bubble is clearly missing or surplus, the distance
// can vary by several per cent of d. The mean distance of touching bubbles is therefore measured
// over all ranks, by octaves of d. Where it deviates from the desired mean, the thresholds are set
// so that as many bubbles act as are missing or surplus. Bubbles with the smallest ratios insert,
// those with the largest are deleted.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lattice.hpp"
#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "method/constants.hpp"
#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// The overlap ratio of a bubble is equation (3) of the paper:
//   alpha_i = (1 / r_i) sum_j (2 r_i + r_j - l_ij),   r = d / 2, l the distance.
// Every term is clamped at 0, so that pairs out of reach add exactly 0. The ideal value is 2 on a
// line and Lattice<Dim>::kIdealOverlap inside a domain, which is the number of neighbours.

// Returns the term of bubble j at distance l in the sum of bubble i.
inline double overlap(double d_i, double d_j, double l) {
  const double term = d_i + 0.5 * d_j - l;
  return term > 0 ? term : 0.0;
}

// Returns the overlap ratio of node i. Its adjacency list must be up to date.
template <int Dim>
double overlap_ratio(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i) {
  const Point<Dim> x = nodes.position(i);
  double sum = 0;
  lists.for_neighbours(i, [&](std::int64_t j) {
    sum += overlap(nodes.d(i), nodes.d(j), distance<Dim>(x, nodes.position(j)));
  });
  return sum / (0.5 * nodes.d(i));
}

// The rules of population control, which hold for all octaves of d.
struct PopulationRule {
  int dimension;  // of the region that the bubbles fill: 2 (area) or 3 (volume)
  double ideal;   // overlap ratio of a bubble among neighbours at its d
  // Bubbles with a larger overlap ratio are deleted, whatever the mean distance is.
  double delete_above;
  // New bubbles are inserted beside those with a smaller ratio, whatever the mean distance is.
  double insert_below;
  double mean_distance;  // desired mean distance of touching bubbles, in desired distances; 0: none
  // The smallest distances of a new bubble from others, in spacings. The second one holds for
  // insertions that reduce the mean distance.
  double min_gap = method::kMinGap;
  double min_gap_to_aim = method::kMinGapToAim;
};

// The thresholds of the overlap ratio by octaves of d. A bubble above delete_above is deleted.
// Beside a bubble below insert_below one is inserted to reduce the mean distance.
struct PopulationThresholds {
  struct Pair {
    double insert_below, delete_above;
  };
  int first_octave = 0;
  std::vector<Pair> octaves;  // from first_octave on; other d use the nearest octave

  explicit PopulationThresholds(const PopulationRule& rule) : octaves{{0, rule.delete_above}} {}
  // Returns the thresholds of a bubble with spacing d.
  const Pair& at(double d) const;
};

// Returns the overlap ratios of the nodes that move, and 0 for the others.
template <int Dim>
View<double> overlap_ratios(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists);

// Returns the thresholds for the present distances. Octaves whose mean distance deviates from the
// desired one by no more than the tolerance keep the thresholds of the rule. All ranks must call
// it, and if one rank throws, all ranks throw.
template <int Dim>
PopulationThresholds choose_thresholds(const Communicator& comm, const Nodes<Dim>& nodes,
                                       const AdjacencyList<Dim>& lists, const View<double>& ratios,
                                       const PopulationRule& rule, double tolerance);

}  // namespace pnpbs
