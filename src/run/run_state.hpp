// SPDX-License-Identifier: BSD-3-Clause
// The state of a placement's simulation, with its counts and warnings. Calls that may fail copy it
// first and restore the copy on failure.
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

// The reason why a run ended.
enum class StopReason { none, rest, step_limit, monitor };

// The schedule of the present level, and the counts and warnings of the placement.
struct RunState {
  Schedule schedule;  // of the present level
  Speeds last_speeds;
  StopReason stop_reason = StopReason::none;
  Outcome outcome = Outcome::converged;  // of the last run that reached its end

  int coarser_levels = 0;  // levels that the nodes came from

  // Totals since the placement was created, on all levels.
  std::int64_t steps_done = 0, inserted = 0, deleted = 0;
  std::int64_t dropped = 0, unknown_uses = 0;  // of the last run
  // Counts of levels that were released. The unknown uses are those of this rank.
  std::int64_t rebuilds_before = 0, rebalances_before = 0, unknown_uses_before = 0;

  std::vector<Warning> warnings;
  // The first of `warnings` belong to the level, the others to the last run.
  std::size_t warnings_of_level = 0;
  // Measures of the level's finish.
  std::vector<EdgeBand> edge_bands;
  SurfaceFit surface_fit;

  void warn(const std::optional<Warning>& warning) {
    if (warning) warnings.push_back(*warning);
  }
  void forget_warnings_of_run() {
    warnings.erase(warnings.begin() + static_cast<std::ptrdiff_t>(warnings_of_level),
                   warnings.end());
  }
  // Adds the counts of a level that is about to be released.
  template <class Level>
  void add_counts_of(const Level& level) {
    rebuilds_before += level.neighbourhood.rebuilds();
    rebalances_before += level.rebalances;
    unknown_uses_before += level.unknown_uses;
  }
  // Returns to the state `then`, in which `level` was the present one. Counts continue from now.
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
  // Clears the measures of the finish, for a new level.
  void forget_finish() {
    edge_bands.clear();
    surface_fit = {};
  }
};

}  // namespace pnpbs
