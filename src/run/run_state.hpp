// SPDX-License-Identifier: BSD-3-Clause
// Where a placement's simulation is, and what is told of it: copied before what may fail, and put
// back if it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/warning.hpp"
#include "level/finish.hpp"
#include "level/speeds.hpp"
#include "level/volume/surface_fit.hpp"
#include "run/outcome.hpp"
#include "run/schedule.hpp"

namespace pnpbs {

// Why a run ended, for the report.
enum class StopReason { none, rest, step_limit, monitor };

struct RunState {
  Schedule schedule;  // of the level there is
  Speeds last_speeds;
  StopReason stop_reason = StopReason::none;
  Outcome outcome = Outcome::converged;  // of the last run that came to its end

  int coarser_levels = 0;  // that the nodes came from

  // Since the placement was made, on all levels.
  std::int64_t steps_done = 0, inserted = 0, deleted = 0;
  std::int64_t dropped = 0, unknown_uses = 0;  // of the last run
  // Of levels that are no more; unknown uses are this rank's.
  std::int64_t rebuilds_before = 0, rebalances_before = 0, unknown_uses_before = 0;

  std::vector<Warning> warnings;
  std::size_t warnings_of_level = 0;  // the first of them; the others are of the last run
  // Of the level's finish.
  std::vector<EdgeBand> edge_bands;
  SurfaceFit surface_fit;

  void warn(const std::optional<Warning>& warning) {
    if (warning) warnings.push_back(*warning);
  }
  void forget_warnings_of_run() {
    warnings.erase(warnings.begin() + static_cast<std::ptrdiff_t>(warnings_of_level),
                   warnings.end());
  }
  // What this level has counted goes on to count when it is no more.
  template <class Level>
  void keep_counts(const Level& level) {
    rebuilds_before += level.neighbourhood.rebuilds();
    rebalances_before += level.rebalances;
    unknown_uses_before += level.unknown_uses;
  }
  // As it was when there was that level, but for what has been counted since.
  template <class Level>
  void go_back_to(RunState then, const Level& level) {
    then.steps_done = steps_done;
    then.inserted = inserted;
    then.deleted = deleted;
    then.unknown_uses = unknown_uses;
    then.rebuilds_before = rebuilds_before - level.neighbourhood.rebuilds();
    then.rebalances_before = rebalances_before - level.rebalances;
    then.unknown_uses_before = unknown_uses_before - level.unknown_uses;
    *this = std::move(then);
  }
  // No finish has been done on the next one.
  void forget_finish() {
    edge_bands.clear();
    surface_fit = {};
  }
};

}  // namespace pnpbs
