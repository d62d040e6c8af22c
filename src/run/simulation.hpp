// SPDX-License-Identifier: BSD-3-Clause
// The simulation of a level: steps, the events between them, and the finish. Coarser levels and
// surfaces have their own simulations.
#pragma once

#include <cstdint>

#include "level/level.hpp"
#include "level/population_events.hpp"
#include "level/volume/boundary_refinement.hpp"
#include "method/constants.hpp"
#include "run/monitoring.hpp"
#include "run/outcome.hpp"
#include "run/run_state.hpp"
#include "run/schedule.hpp"

namespace pnpbs {

// Returns the maximum number of steps of a run on this level. Where d is reduced locally its slope
// jumps, and bubbles take longer to rest.
template <int Dim>
std::int64_t max_steps(const Level<Dim>& level) {
  return (level.held_rounds > 0 ? method::kStepsWhereHeld : 1) * level.settings.steps;
}

// Advances one level. All ranks must call its functions, and if one rank throws, all ranks throw.
template <int Dim>
class Simulation {
 public:
  // Continues the simulation of `level` from `schedule`, and adds to the counts of `run`. The
  // arguments must outlive this object.
  Simulation(Level<Dim>& level, Schedule& schedule, RunState& run, Monitoring& monitoring)
      : level_(level), schedule_(schedule), run_(run), monitoring_(monitoring) {}

  // Does steps up to step number `until` of the schedule, or until the bubbles rest. `part` is the
  // range of the call's work that these steps are.
  Outcome advance(std::int64_t until, ProgressPart part);
  // Completes a run after the steps: first what options request, then sweeps and repairs. The nodes
  // are valid after each part. `fraction` is the fraction of the call's work that is done before
  // it. Returns `converged` or `stopped`.
  Outcome finish(double fraction);
  // Inserts nodes where tetrahedra cross inner surfaces, and repairs the elements again. To be
  // called after finish(), with the same fraction and return value.
  Outcome follow_inner_surfaces(double fraction);

  // --- parts of these, for callers that run them one by one ---
  // Returns the counts of all ranks.
  PopulationCounts adjust_population();
  void remove_crowded();
  // Inserts or deletes nodes at defects that the overlap ratio does not detect. Plane only.
  void repair_defects();
  // Repartitions the nodes over the ranks.
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
  void place_first_row();
  void split_elements_on_boundary();
  Outcome smooth(double fraction, std::int64_t sweeps, RefinedSurfaces surfaces);
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
