// SPDX-License-Identifier: BSD-3-Clause
// Where a placement's simulation is, and what is told of it: copied before what may fail, and put
// back if it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "level/finish.hpp"
#include "level/speeds.hpp"
#include "level/volume/surface_fit.hpp"

namespace pnpbs {

// Where the simulation of a level is. Events happen at step numbers of it.
struct Schedule {
  std::int64_t step = 0;
  bool refined = false;     // it began with the nodes of a coarser level
  bool coarser = false;     // it is one, or that of the surfaces
  bool multiplied = false;  // its spacing is a multiple of the one that counts
  bool taken_over = false;  // it began with nodes given, or placed for another spacing
  bool ended = false;
  bool at_event = false;  // restored as it was in the middle of one: is all at rest?
  bool population_settled = false;
  int quiet_events = 0;          // that changed too little to pay, in a row
  double imbalance_reached = 1;  // by the last rebalancing
};

// Why a run ended, for the report.
enum class StopReason { none, rest, step_limit, monitor };

struct RunState {
  Schedule schedule;  // of the level there is
  Speeds last_speeds;
  StopReason stop_reason = StopReason::none;

  int coarser_levels = 0;  // that the nodes came from
  int filled_level = 0;    // of these, how many had their inside filled, the first by a lattice

  // Since the placement was made, on all levels.
  std::int64_t steps_done = 0, inserted = 0, deleted = 0;
  std::int64_t dropped = 0, unknown_uses = 0;  // of the last run
  // Of levels that are no more; unknown uses are this rank's.
  std::int64_t rebuilds_before = 0, rebalances_before = 0, unknown_uses_before = 0;

  std::vector<std::string> warnings;
  std::size_t warnings_of_level = 0;  // the first of them; the others are of the last run
  // Of the level's finish.
  std::vector<EdgeBand> edge_bands;
  SurfaceFit surface_fit;
};

}  // namespace pnpbs
