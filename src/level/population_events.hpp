// SPDX-License-Identifier: BSD-3-Clause
// The events that insert and delete nodes of a level (section 2.4).
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"
#include "method/constants.hpp"
#include "population/population.hpp"

namespace pnpbs {

// Numbers of inserted and deleted nodes.
struct PopulationCounts {
  std::int64_t inserted = 0;
  std::int64_t deleted = 0;
};

// Inserts and deletes bubbles by the thresholds of the settings. Where the mean distance deviates
// by more than the tolerance, the thresholds are adapted to it. Returns the counts of this rank.
// All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
PopulationCounts adjust_population(Level<Dim>& level,
                                   double tolerance = method::kDistanceTolerance);
// Inserts and deletes nodes where this repairs defects of the Delaunay stars. Does nothing in
// space. All ranks must call it, and if one rank throws, all ranks throw.
PopulationCounts repair_defects(Level<2>& level);
PopulationCounts repair_defects(Level<3>& level);

// Makes one node over each regular edge of the boundary the first row of inner nodes. Does nothing
// in space. All ranks must call it, and if one rank throws, all ranks throw.
PopulationCounts place_first_row(Level<2>& level);
PopulationCounts place_first_row(Level<3>& level);

// Splits the elements with all nodes on the boundary by nodes at the middles of their longest inner
// edges. Does nothing in space. All ranks must call it, and if one rank throws, all ranks throw.
PopulationCounts split_elements_on_boundary(Level<2>& level);
PopulationCounts split_elements_on_boundary(Level<3>& level);

// Deletes nodes of this rank, including ghosts, given by ascending memory index. Local.
template <int Dim>
void delete_nodes(Level<Dim>& level, const std::vector<std::int32_t>& deleted);

}  // namespace pnpbs
