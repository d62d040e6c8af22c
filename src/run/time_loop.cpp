// SPDX-License-Identifier: BSD-3-Clause
// The time loop: steps, the events between them, and the finish.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/finish.hpp"
#include "level/node_spacing.hpp"
#include "level/plane/closed_sphere.hpp"
#include "level/population_events.hpp"
#include "level/rebalance.hpp"
#include "level/room.hpp"
#include "level/speeds.hpp"
#include "level/time_step.hpp"
#include "level/undersampled_points.hpp"
#include "level/volume/boundary_refinement.hpp"
#include "method/constants.hpp"
#include "run/simulation.hpp"

namespace pnpbs {

template <int Dim>
Outcome Simulation<Dim>::advance(std::int64_t until, ProgressPart part) {
  const Settings& settings = level_.settings;
  hold_margin(level_);
  const double first = static_cast<double>(schedule_.step);
  Outcome outcome = Outcome::not_converged;
  run_.stop_reason = StopReason::step_limit;
  std::exception_ptr failure;  // local failure; reported to the other ranks at the next event
  bool started = true;
  if (std::exchange(schedule_.progress, Progress::steps) == Progress::at_event && bubbles_rest()) {
    run_.stop_reason = StopReason::rest;
    return Outcome::converged;
  }
  while (schedule_.step < until) {
    if (started || schedule_.step % settings.event_interval % settings.exchange_interval == 0)
      exchange_for_steps(level_, failure);
    started = false;
    pnpbs::step(level_, failure);
    ++schedule_.step;
    ++run_.steps_done;
    const bool is_event = schedule_.step % settings.event_interval == 0;
    if (is_event || schedule_.step == until || !level_.distributed())
      agree_on_failure(*level_.comm, failure);
    const double done = (static_cast<double>(schedule_.step) - first) /
                        std::max(1.0, static_cast<double>(until) - first);
    const double fraction = part.begin + done * (part.end - part.begin);
    if (is_event) event();
    if (stops_after_step(is_event, fraction)) {
      if (!is_event) refresh_spacing(level_);  // results have d at the present positions
      outcome = Outcome::stopped;
      run_.stop_reason = StopReason::monitor;
      break;
    }
    if (is_event && bubbles_rest()) {
      outcome = Outcome::converged;
      run_.stop_reason = StopReason::rest;
      break;
    }
  }
  return outcome;
}

// Calls the monitor after a step. One rank does so between events as well, because those of ten
// million nodes are seconds apart. Several ranks have fewer nodes each and would need a reduction
// after every step, so they call it at events only. Nodes of coarser levels cannot be saved,
// because these levels are released later.
template <int Dim>
bool Simulation<Dim>::stops_after_step(bool is_event, double fraction) {
  if (!is_event && (level_.distributed() || !monitoring_.is_due())) return false;
  return monitoring_.stops_between_steps(is_event, schedule_.role == LevelRole::result, fraction,
                                         level_.owned_count());
}

// Does the work of an event, in a fixed order.
template <int Dim>
void Simulation<Dim>::event() {
  const Settings& settings = level_.settings;
  run_.last_speeds = speeds_of(level_);
  refresh_spacing(level_);
  if (schedule_.role != LevelRole::coarser) require_sampled_spacing(level_);
  const double population_until =
      std::floor(settings.population_share * static_cast<double>(max_steps(level_)));
  if (static_cast<double>(schedule_.step) > population_until && !far_too_few())
    schedule_.population_settled = true;
  if (!schedule_.population_settled)
    control_population();  // also updates the ghosts; otherwise the next step does
  keep_balance();
}

// Repartitions when the imbalance exceeds `rebalance_above`, unless the last repartitioning reached
// no better balance.
template <int Dim>
void Simulation<Dim>::keep_balance() {
  if (!level_.distributed()) return;
  constexpr double kNoBetter = 1.02;
  const double imbalance = imbalance_of(level_);
  if (imbalance <=
      std::max(level_.settings.rebalance_above, kNoBetter * schedule_.imbalance_reached))
    return;
  rebalance();
}

template <int Dim>
void Simulation<Dim>::rebalance() {
  pnpbs::rebalance(level_);
  schedule_.imbalance_reached = imbalance_of(level_);
}

// Returns whether there are far fewer nodes than expected. Given nodes may be so few that
// population control needs more time than usual.
template <int Dim>
bool Simulation<Dim>::far_too_few() const {
  // The expected number is unknown on surfaces.
  if (level_.settings.bubble_dimension < Dim) return false;
  return nodes() < method::kFarTooFew * expected_nodes(level_);
}

// Returns the tolerance of the mean distance in this round of an event, or infinity. Population
// control corrects only deviations that exceed it.
// In the plane and on surfaces one round corrects the mean. Inside a body a hole has some 14
// candidates, of which only one wins, so two rounds do.
// Taken-over nodes have a wider tolerance, because they should stay where d is unchanged. There the
// correction goes on in all rounds while the deviation is large, because no overlap ratio detects
// that every eighth node is missing.
// A lattice on the finest level is corrected only if the deviation is large, because insertions
// damage it.
template <int Dim>
double Simulation<Dim>::distance_tolerance(int round) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // An error on a coarser level is an error on all finer ones. On the finest level each change
  // costs steps.
  const double tolerance =
      (schedule_.role == LevelRole::result ? method::kDistanceToleranceOnFinest : 1) *
      method::kDistanceTolerance;
  if (level_.settings.bubble_dimension == 2) return round == 0 ? tolerance : kNever;
  if (schedule_.taken_over()) return round < 2 ? method::kDistanceOff : method::kDistanceFarOff;
  if (round >= 2) return kNever;
  return schedule_.role != LevelRole::result || schedule_.refined() ? tolerance
                                                                    : method::kDistanceFarOff;
}

// Adjusts the population until changes no longer pay. A new spacing may require many times the
// present number of nodes, while one contest lets few candidates act. The contest is therefore
// repeated while it changes many nodes.
template <int Dim>
void Simulation<Dim>::control_population() {
  const double nodes = this->nodes();
  double changed = 0;
  for (int round = 0; round < method::kMaxPopulationRounds; ++round) {
    const PopulationCounts change =
        counted(pnpbs::adjust_population(level_, distance_tolerance(round)));
    const double acted = static_cast<double>(change.inserted + change.deleted);
    changed += acted;
    if (acted < method::kMuchChange * nodes) break;
  }
  const Settings& settings = level_.settings;
  // New nodes may make room for more, so two quiet events in a row are required. After a coarser
  // level few changes remain.
  const bool quiet = changed <= (schedule_.refined() ? method::kRefinedTolerance : 1) *
                                    settings.population_tolerance * nodes;
  schedule_.quiet_events = quiet ? schedule_.quiet_events + 1 : 0;
  schedule_.population_settled =
      schedule_.quiet_events >=
          (schedule_.refined() ? method::kQuietEventsRefined : method::kQuietEvents) &&
      !far_too_few();
}

// Returns whether the bubbles rest. The speeds do not matter while the population still changes.
template <int Dim>
bool Simulation<Dim>::bubbles_rest() const {
  const Settings& settings = level_.settings;
  return schedule_.population_settled && run_.last_speeds.mean < settings.tolerance_mean &&
         run_.last_speeds.max < settings.tolerance_max;
}

// Calls the monitor between the parts of the finish, and returns whether it stops the run.
template <int Dim>
bool Simulation<Dim>::stops_in_finish(double fraction) {
  if (!monitoring_.is_due_anywhere() || !monitoring_.stops(fraction, level_.owned_count()))
    return false;
  refresh_spacing(level_);
  run_.stop_reason = StopReason::monitor;
  return true;
}

template <int Dim>
Outcome Simulation<Dim>::finish(double fraction) {
  if (level_.settings.runge_kutta_finish) {
    finish_by_runge_kutta(level_);
    ++run_.steps_done;
  }
  free_margin(level_);
  place_first_row();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  repair_defects();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  remove_crowded();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  if (smooth(fraction, level_.settings.sweeps, RefinedSurfaces::boundary) == Outcome::stopped)
    return Outcome::stopped;
  if (centre_cells(fraction) == Outcome::stopped) return Outcome::stopped;
  split_elements_on_boundary();
  refresh_spacing(level_);
  return Outcome::converged;
}

template <int Dim>
Outcome Simulation<Dim>::follow_inner_surfaces(double fraction) {
  const Outcome outcome = smooth(fraction, 0, RefinedSurfaces::boundary_and_inner);
  if (outcome != Outcome::stopped) refresh_spacing(level_);
  return outcome;
}

// Sweeps and repairs, in space alternating with the refinement of the boundary. Nodes inserted at
// the boundary cause small angles, which repairs remove. Repairs in turn may bring inner nodes
// close to wide boundary triangles, which opens the boundary again.
template <int Dim>
Outcome Simulation<Dim>::smooth(double fraction, std::int64_t sweeps, RefinedSurfaces surfaces) {
  const auto refine = [&] {
    const PopulationCounts counts = refine_boundary(level_, surfaces);
    run_.inserted += counts.inserted;
    run_.deleted += counts.deleted;
    return counts.inserted + counts.deleted > 0;
  };
  refine();
  for (int repairs = 0; repairs < method::kMaxFinishRounds; ++repairs) {
    if (stops_in_finish(fraction)) return Outcome::stopped;
    const FinishResults results =
        sweep_and_repair(level_, sweeps, [&] { return stops_in_finish(fraction); });
    counted(results.counts);
    if (results.stopped) return Outcome::stopped;
    run_.edge_bands = results.edge_bands;
    if (!refine()) break;
    sweeps = 0;
  }
  return Outcome::converged;
}

// Moves nodes to the centroids of their Voronoi cells, in blocks of sweeps. The stars and d are
// renewed before each block. Then repairs the few obtuse triangles.
template <int Dim>
Outcome Simulation<Dim>::centre_cells(double fraction) {
  constexpr std::int64_t kBlock = method::kSweepsOnStars;
  const std::int64_t sweeps = Dim == 2 ? level_.settings.centroidal_sweeps : 0;
  for (std::int64_t done = 0; done < sweeps; done += kBlock) {
    const double share = static_cast<double>(done) / static_cast<double>(sweeps);
    if (stops_in_finish(fraction + share * (1 - fraction))) return Outcome::stopped;
    refresh_spacing(level_);
    run_.edge_bands = sweep_to_centroids(level_, std::min(kBlock, sweeps - done));
  }
  const std::int64_t rounds = level_.settings.obtuse_rounds;
  if (rounds > 0) repair_obtuse_triangles(level_, rounds);
  return Outcome::converged;
}

// Removes coincident nodes first, because they have no star. The rounds end unless each changes
// less than the one before: where d jumps, two rounds may undo each other's changes again and
// again.
template <int Dim>
void Simulation<Dim>::repair_defects() {
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t round = 0; round < level_.settings.defects.rounds && max > 1; ++round) {
    remove_crowded();
    const PopulationCounts change = counted(pnpbs::repair_defects(level_));
    const std::int64_t changes = change.inserted + change.deleted;
    if (changes > 0) refresh_spacing(level_);  // a new node has the d of another one
    if (changes == 0 || changes >= max) break;
    max = changes;
  }
}

// Fits the first row of inner nodes to the boundary. Sweeps follow, which smooth the nodes behind
// it. Coincident nodes are removed first, because one of them would become a node of the row.
template <int Dim>
void Simulation<Dim>::place_first_row() {
  if (!level_.settings.makes_first_row()) return;
  remove_crowded();
  const PopulationCounts change = counted(pnpbs::place_first_row(level_));
  if (change.inserted + change.deleted > 0) refresh_spacing(level_);
}

// Splits the elements with all nodes on the boundary, and repairs the triangles around. Such a
// repair may make elements of this kind again, so that a round ends with the split.
template <int Dim>
void Simulation<Dim>::split_elements_on_boundary() {
  if (!level_.settings.split_elements_on_boundary) return;
  for (int round = 1; counted(pnpbs::split_elements_on_boundary(level_)).inserted > 0; ++round) {
    if (round == method::kMaxFinishRounds) break;
    refresh_spacing(level_);  // a new node has the d of another one
    repair_bad_triangles(level_);
  }
}

template <int Dim>
PopulationCounts Simulation<Dim>::adjust_population() {
  return counted(pnpbs::adjust_population(level_));
}

template <int Dim>
void Simulation<Dim>::remove_crowded() {
  counted(pnpbs::remove_crowded(level_));
}

// Sums the counts over all ranks, and adds them to those of the run.
template <int Dim>
PopulationCounts Simulation<Dim>::counted(PopulationCounts change) {
  const Communicator& comm = *level_.comm;
  change.inserted =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(change.inserted)));
  change.deleted =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(change.deleted)));
  run_.inserted += change.inserted;
  run_.deleted += change.deleted;
  return change;
}

// Returns the number of nodes on all ranks.
template <int Dim>
double Simulation<Dim>::nodes() const {
  return static_cast<double>(
      level_.comm->allreduce_sum(static_cast<std::uint64_t>(level_.owned_count())));
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace pnpbs
