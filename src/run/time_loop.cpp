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
  std::exception_ptr failure;  // of this rank: told to the others at the next event
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
      if (!is_event) refresh_spacing(level_);  // as d is at the nodes now
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

// The steps between two events of ten million nodes take some seconds. Several ranks have fewer
// nodes each, and would have to agree every time: they are asked at events. On coarser levels,
// which do not stay, nothing can be saved.
template <int Dim>
bool Simulation<Dim>::stops_after_step(bool is_event, double fraction) {
  if (!is_event && (level_.distributed() || !monitoring_.is_due())) return false;
  return monitoring_.stops_between_steps(is_event, schedule_.role == LevelRole::result, fraction,
                                         level_.owned_count());
}

// What happens at an event, in this order.
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
    control_population();  // renews the ghosts, too; else the next step does
  keep_balance();
}

// Deals the work out anew where it has become unequal, unless it was no better after the last time.
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

// Nodes given from outside may be so few that they take longer to multiply.
template <int Dim>
bool Simulation<Dim>::far_too_few() const {
  if (level_.settings.bubble_dimension < Dim) return false;  // of surfaces it is not known
  return nodes() < method::kFarTooFew * expected_nodes(level_);
}

// How far the mean distance may be off in this round of an event; else the population is aimed at
// it. In the plane and on surfaces that is done once in an event; inside of a body a hole has 14
// bidders, of which one wins, so it is done twice, and where nodes were taken over, for as long as
// it is far off: no overlap ratio tells that every eighth node is missing. But there those should
// stay where d has stayed. And a lattice that fills the finest level is left alone, as what comes
// to it damages it.
template <int Dim>
double Simulation<Dim>::distance_tolerance(int round) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // What is off on a coarser level is off on all finer ones; on the finest each change costs steps.
  const double tolerance =
      (schedule_.role == LevelRole::result ? method::kDistanceToleranceOnFinest : 1) *
      method::kDistanceTolerance;
  if (level_.settings.bubble_dimension == 2) return round == 0 ? tolerance : kNever;
  if (schedule_.taken_over()) return round < 2 ? method::kDistanceOff : method::kDistanceFarOff;
  if (round >= 2) return kNever;
  return schedule_.role != LevelRole::result || schedule_.refined() ? tolerance
                                                                    : method::kDistanceFarOff;
}

// Adjusts the population while it pays. A new spacing may ask for many times the nodes there are,
// of which one contest lets few act: so there are more rounds at once while they change much.
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
  // Nodes that have just come may make room for more: so twice in a row. After a coarser level
  // there is little left to do.
  const bool quiet = changed <= (schedule_.refined() ? method::kRefinedTolerance : 1) *
                                    settings.population_tolerance * nodes;
  schedule_.quiet_events = quiet ? schedule_.quiet_events + 1 : 0;
  schedule_.population_settled =
      schedule_.quiet_events >=
          (schedule_.refined() ? method::kQuietEventsRefined : method::kQuietEvents) &&
      !far_too_few();
}

// While the population still changes, rest means nothing.
template <int Dim>
bool Simulation<Dim>::bubbles_rest() const {
  const Settings& settings = level_.settings;
  return schedule_.population_settled && run_.last_speeds.mean < settings.tolerance_mean &&
         run_.last_speeds.max < settings.tolerance_max;
}

// Asked between the parts of the finish.
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
  lay_first_row();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  repair_defects();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  remove_crowded();
  if (stops_in_finish(fraction)) return Outcome::stopped;
  if (smooth(fraction) == Outcome::stopped) return Outcome::stopped;
  if (centre_cells(fraction) == Outcome::stopped) return Outcome::stopped;
  refresh_spacing(level_);
  return Outcome::converged;
}

// Sweeps and repairs. In space what comes to the boundary before them makes small angles, which are
// repaired, and they may leave it anew where nodes from inside come near a wide triangle.
template <int Dim>
Outcome Simulation<Dim>::smooth(double fraction) {
  std::int64_t sweeps = level_.settings.sweeps;
  const auto refine = [this] {
    const PopulationCounts counts = refine_boundary(level_);
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

// Sweeps in blocks, for each of which stars are found and d is asked again; then the few triangles
// that are obtuse.
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

// Nodes that coincide would have no star, so they go first. Rounds must do less and less: where d
// jumps, what one brings another may take away, for ever.
template <int Dim>
void Simulation<Dim>::repair_defects() {
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t round = 0; round < level_.settings.defects.rounds && max > 1; ++round) {
    remove_crowded();
    const PopulationCounts change = counted(pnpbs::repair_defects(level_));
    const std::int64_t changes = change.inserted + change.deleted;
    if (changes > 0) refresh_spacing(level_);  // a new node has another's so far
    if (changes == 0 || changes >= max) break;
    max = changes;
  }
}

// Before sweeps, which even out what is behind it. Of nodes that coincide one would go there.
template <int Dim>
void Simulation<Dim>::lay_first_row() {
  if (!level_.settings.lays_first_row()) return;
  remove_crowded();
  const PopulationCounts change = counted(pnpbs::lay_first_row(level_));
  if (change.inserted + change.deleted > 0) refresh_spacing(level_);
}

template <int Dim>
PopulationCounts Simulation<Dim>::adjust_population() {
  return counted(pnpbs::adjust_population(level_));
}

template <int Dim>
void Simulation<Dim>::remove_crowded() {
  counted(pnpbs::remove_crowded(level_));
}

// Over all ranks, and in the run.
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

// Of all ranks.
template <int Dim>
double Simulation<Dim>::nodes() const {
  return static_cast<double>(
      level_.comm->allreduce_sum(static_cast<std::uint64_t>(level_.owned_count())));
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace pnpbs
