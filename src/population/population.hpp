// SPDX-License-Identifier: BSD-3-Clause
// Adjusting the bubble population (section 2.4 of the paper): bubbles whose overlap ratio is too
// large go, and in the largest holes beside those whose ratio is too small new ones appear. Who
// acts is a contest: a candidate does so if its (defect, id) is the strict maximum within three
// hops of the adjacency lists. All read the state before the event, so the outcome has no order.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "population/population_thresholds.hpp"

namespace pnpbs {

template <int Dim>
struct Birth {
  Point<Dim> position;
  std::int64_t parent;  // id
  double d;             // the parent's
  std::int32_t boundary_node = -1;
};

template <int Dim>
struct PopulationChange {
  std::vector<std::int32_t> deleted;  // nodes
  std::vector<Birth<Dim>> born;       // in no particular order; ids follow from the place
  std::vector<std::int32_t> parents;  // of those born: nodes
};

// must_go(i): node i has no room and goes whatever its ratio. free_place(i): where a new bubble
// would come beside node i. fits(x, d): is a new bubble allowed
// at x by the domain? Lists must be fresh, with a radius of at least 1.5.
template <int Dim>
PopulationChange<Dim> choose_population_change(
    const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const View<double>& ratios,
    const PopulationRule& rule, const PopulationThresholds& thresholds,
    const std::function<bool(std::int64_t)>& must_go,
    const std::function<Point<Dim>(std::int64_t)>& free_place,
    const std::function<bool(const Point<Dim>&, double)>& fits);

}  // namespace pnpbs
