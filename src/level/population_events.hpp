// SPDX-License-Identifier: BSD-3-Clause
// The population of a level changes (section 2.4): bubbles are inserted and deleted.
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"
#include "method/constants.hpp"
#include "population/population.hpp"

namespace pnpbs {

struct PopulationCounts {
  std::int64_t inserted = 0;
  std::int64_t deleted = 0;
};

// By the thresholds of the settings and, where the mean distance is off by more than the tolerance,
// by those that it asks for. Counts are of this rank. Collective.
template <int Dim>
PopulationCounts adjust_population(Level<Dim>& level,
                                   double tolerance = method::kDistanceTolerance);
// Deletes and inserts where defects of the Delaunay stars are repaired by it. Collective.
PopulationCounts repair_defects(Level<2>& level);
PopulationCounts repair_defects(Level<3>& level);

// Makes one node over each regular edge of the boundary the first row of the inner nodes; in the
// plane only. Collective.
PopulationCounts lay_first_row(Level<2>& level);
PopulationCounts lay_first_row(Level<3>& level);

// Of this rank, ghosts among them; in the order of memory.
template <int Dim>
void delete_nodes(Level<Dim>& level, const std::vector<std::int32_t>& deleted);

}  // namespace pnpbs
