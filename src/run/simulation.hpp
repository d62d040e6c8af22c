// SPDX-License-Identifier: BSD-3-Clause
// The simulation of a level: steps, the events between them, and the finish. Coarser levels and
// surfaces have one of their own.
#pragma once

#include <cstdint>

#include "level/level.hpp"
#include "level/population_events.hpp"
#include "method/constants.hpp"
#include "run/monitoring.hpp"
#include "run/outcome.hpp"
#include "run/run_state.hpp"
#include "run/schedule.hpp"

namespace pnpbs {

// Of a run on this level. Where d is held down it jumps in slope, and bubbles take longer to rest.
template <int Dim>
std::int64_t max_steps(const Level<Dim>& level) {
  return (level.held_rounds > 0 ? method::kStepsWhereHeld : 1) * level.settings.steps;
}

// All functions are collective.
template <int Dim>
class Simulation {
 public:
  // On this level, from where its schedule is. What is done is counted in the run.
  Simulation(Level<Dim>& level, Schedule& schedule, RunState& run, Monitoring& monitoring)
      : level_(level), schedule_(schedule), run_(run), monitoring_(monitoring) {}

  // Steps on to step number `until` of the schedule, or until the bubbles rest. Events happen at
  // step numbers fixed in advance. `part` is the part of the call's work that this is.
  Outcome advance(std::int64_t until, ProgressPart part);
  // After the steps: what options ask for, then sweeps and repairs. Each part of it leaves valid
  // nodes. `fraction`: of the call's work, what is done by then. Converged, or stopped.
  Outcome finish(double fraction);

  // --- parts of these, for who does them one by one ---
  // The counts are of all ranks.
  PopulationCounts adjust_population();
  void remove_crowded();
  // Where a node is one too many or one is missing that the overlap ratios do not tell.
  void repair_defects();
  // Repartitions the work over the ranks.
  void rebalance();

 private:
  void event();
  void control_population();
  void keep_balance();
  bool bubbles_rest() const;
  bool far_too_few() const;
  double distance_tolerance(int round) const;
  bool stops_after_step(bool is_event, double fraction);
  bool stops_in_finish(double fraction);
  void lay_first_row();
  Outcome smooth(double fraction);
  Outcome centre_cells(double fraction);
  PopulationCounts counted(PopulationCounts change);
  double nodes() const;

  Level<Dim>& level_;
  Schedule& schedule_;
  RunState& run_;
  Monitoring& monitoring_;
};

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace pnpbs
