// SPDX-License-Identifier: BSD-3-Clause
// The time loop: steps, the events between them, and the finish.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/finer_places.hpp"
#include "level/finish.hpp"
#include "level/node_spacing.hpp"
#include "level/population_events.hpp"
#include "level/rebalance.hpp"
#include "level/room.hpp"
#include "level/speeds.hpp"
#include "level/time_step.hpp"
#include "level/volume/boundary_refinement.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

void Placement::begin_schedule(bool refined) {
  state_.schedule = Schedule();
  state_.schedule.refined = refined;
}

// For nodes that are there already, where the last one has ended.
void Placement::begin_schedule_again() {
  const bool lattice = !state_.schedule.refined && !state_.schedule.taken_over;
  begin_schedule(false);
  state_.schedule.taken_over = !lattice;
}

// Steps on to step number `until` of the schedule, or until the bubbles rest. Events happen at
// step numbers fixed in advance. `part` is the part of the call's work that this is.
template <int Dim>
Outcome PlacementOf<Dim>::advance(std::int64_t until, ProgressPart part) {
  const Settings& settings = level_->settings;
  const double first = static_cast<double>(state_.schedule.step);
  Outcome outcome = Outcome::not_converged;
  state_.stop_reason = StopReason::step_limit;
  std::exception_ptr failure;  // of this rank: told to the others at the next event
  bool started = true;
  if (std::exchange(state_.schedule.at_event, false) && bubbles_rest()) {
    state_.stop_reason = StopReason::rest;
    return Outcome::converged;
  }
  while (state_.schedule.step < until) {
    if (started || state_.schedule.step % settings.event_interval % settings.exchange_interval == 0)
      exchange_for_steps(*level_, failure);
    started = false;
    pnpbs::step(*level_, failure);
    ++state_.schedule.step;
    ++state_.steps_done;
    const bool is_event = state_.schedule.step % settings.event_interval == 0;
    if (is_event || state_.schedule.step == until || !level_->distributed())
      agree_on_failure(*comm_, failure);
    const double done = (static_cast<double>(state_.schedule.step) - first) /
                        std::max(1.0, static_cast<double>(until) - first);
    const double fraction = part.begin + done * (part.end - part.begin);
    if (is_event) event();
    if (stops_after_step(is_event, fraction)) {
      if (!is_event) refresh_spacing(*level_);  // as d is at the nodes now
      outcome = Outcome::stopped;
      state_.stop_reason = StopReason::monitor;
      break;
    }
    if (is_event && bubbles_rest()) {
      outcome = Outcome::converged;
      state_.stop_reason = StopReason::rest;
      break;
    }
  }
  return outcome;
}

// The steps between two events of ten million nodes take some seconds. Several ranks have fewer
// nodes each, and would have to agree every time: they are asked at events. On coarser levels,
// which do not stay, nothing can be saved.
template <int Dim>
bool PlacementOf<Dim>::stops_after_step(bool is_event, double fraction) {
  if (!is_event && (level_->distributed() || !monitoring_.is_due())) return false;
  return monitoring_.stops_between_steps(is_event, !state_.schedule.coarser, fraction,
                                         results_.count());
}

// What happens at an event, in this order.
template <int Dim>
void PlacementOf<Dim>::event() {
  const Settings& settings = level_->settings;
  state_.last_speeds = speeds_of(*level_);
  refresh_spacing(*level_);
  if constexpr (Dim == 3)
    if (!state_.schedule.multiplied) require_sampled_spacing(*level_);
  const double population_until =
      std::floor(settings.population_share * static_cast<double>(settings.steps));
  if (static_cast<double>(state_.schedule.step) > population_until && !far_too_few())
    state_.schedule.population_settled = true;
  if (!state_.schedule.population_settled)
    control_population();  // renews the ghosts, too; else the next step does
  keep_balance();
}

// Deals the work out anew where it has become unequal, unless it was no better after the last time.
template <int Dim>
void PlacementOf<Dim>::keep_balance() {
  if (!level_->distributed()) return;
  constexpr double kNoBetter = 1.02;
  const double imbalance = imbalance_of(*level_);
  if (imbalance <=
      std::max(level_->settings.rebalance_above, kNoBetter * state_.schedule.imbalance_reached))
    return;
  rebalance_now();
}

template <int Dim>
void PlacementOf<Dim>::rebalance_now() {
  pnpbs::rebalance(*level_);
  state_.schedule.imbalance_reached = imbalance_of(*level_);
}

// Nodes given from outside may be so few that they take longer to multiply.
template <int Dim>
bool PlacementOf<Dim>::far_too_few() const {
  if (level_->settings.dimension < Dim) return false;  // of surfaces it is not known
  return static_cast<double>(global_count()) < 0.85 * expected_nodes(*level_);
}

// How far the mean distance may be off in this round of an event; else the population is aimed at
// it. In the plane and on surfaces that is done once in an event; inside of a body a hole has 14
// bidders, of which one wins, so it is done twice, and where nodes were taken over, for as long as
// it is far off: no overlap ratio tells that every eighth node is missing. But there those should
// stay where d has stayed. And a lattice that fills the finest level is left alone, as what comes
// to it damages it.
template <int Dim>
double PlacementOf<Dim>::tolerance_of_mean(int round) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr double kOff = 0.01, kFarOff = 0.02;
  // What is off on a coarser level is off on all finer ones; on the finest each change costs steps.
  const double tolerance = (state_.schedule.coarser ? 1 : 3) * kMeanTolerance;
  if (level_->settings.dimension == 2) return round == 0 ? tolerance : kNever;
  if (state_.schedule.taken_over) return round < 2 ? kOff : kFarOff;
  if (round >= 2) return kNever;
  return state_.schedule.coarser || state_.schedule.refined ? tolerance : kFarOff;
}

// Adjusts the population while it pays. A new spacing may ask for many times the nodes there are,
// of which one contest lets few act: so there are more rounds at once while they change much.
template <int Dim>
void PlacementOf<Dim>::control_population() {
  constexpr int kMaxRounds = 20;
  constexpr double kMuch = 0.002;     // share of the nodes
  constexpr double kRefinedPays = 5;  // times the option's share
  const double nodes = static_cast<double>(global_count());
  double changed = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const PopulationCounts change =
        count_population_change(pnpbs::adjust_population(*level_, tolerance_of_mean(round)));
    const double acted = static_cast<double>(change.inserted + change.deleted);
    changed += acted;
    if (acted < kMuch * nodes) break;
  }
  const Settings& settings = level_->settings;
  // Nodes that have just come may make room for more: so twice in a row. After a coarser level
  // there is little left to do.
  const bool quiet = changed <= (state_.schedule.refined ? kRefinedPays : 1) *
                                    settings.population_tolerance * nodes;
  state_.schedule.quiet_events = quiet ? state_.schedule.quiet_events + 1 : 0;
  state_.schedule.population_settled =
      state_.schedule.quiet_events >= (state_.schedule.refined ? 1 : 2) && !far_too_few();
}

// While the population still changes, rest means nothing.
template <int Dim>
bool PlacementOf<Dim>::bubbles_rest() const {
  const Settings& settings = level_->settings;
  return state_.schedule.population_settled && state_.last_speeds.mean < settings.tolerance_mean &&
         state_.last_speeds.max < settings.tolerance_max;
}

// Each part of it leaves valid nodes.
template <int Dim>
Outcome PlacementOf<Dim>::finish() {
  const Settings& settings = level_->settings;
  const auto stops = [this] {
    if (!monitoring_.is_due_anywhere() || !monitoring_.stops(part_of_steps().end, results_.count()))
      return false;
    refresh_spacing(*level_);
    state_.stop_reason = StopReason::monitor;
    return true;
  };
  if (settings.runge_kutta_finish) {
    finish_by_runge_kutta(*level_);
    ++state_.steps_done;
  }
  repair_defects();
  if (stops()) return Outcome::stopped;
  count_population_change(remove_crowded(*level_));
  if (stops()) return Outcome::stopped;
  if (smooth([&] { return stops(); }) == Outcome::stopped) return Outcome::stopped;
  refresh_spacing(*level_);
  if constexpr (Dim == 3) measure_finish();
  gather_unknown_uses();
  return Outcome::converged;
}

// Sweeps and repairs. In space what comes to the boundary before them makes small angles, which are
// repaired, and they may leave it anew where nodes from inside come near a wide triangle.
template <int Dim>
template <class Stops>
Outcome PlacementOf<Dim>::smooth(const Stops& stops) {
  constexpr int kMostRepairs = 3;
  std::int64_t sweeps = level_->settings.sweeps;
  const auto refine = [this] {
    const PopulationCounts counts = refine_boundary(*level_);
    state_.inserted += counts.inserted;
    state_.deleted += counts.deleted;
    return counts.inserted + counts.deleted > 0;
  };
  refine();
  for (int repairs = 0; repairs < kMostRepairs; ++repairs) {
    if (stops()) return Outcome::stopped;
    const FinishResults results = sweep_and_repair(*level_, sweeps);
    count_population_change(results.counts);
    state_.edge_bands = results.edge_bands;
    if (!refine()) break;
    sweeps = 0;
  }
  return Outcome::converged;
}

// Where a node is one too many or one is missing that the overlap ratios do not tell. Nodes that
// coincide would have no star, so they go first. Rounds must do less and less: where d jumps, what
// one brings another may take away, for ever.
template <int Dim>
void PlacementOf<Dim>::repair_defects() {
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t round = 0; round < level_->settings.defects.rounds && max > 1; ++round) {
    count_population_change(remove_crowded(*level_));
    const PopulationCounts change = count_population_change(pnpbs::repair_defects(*level_));
    const std::int64_t changes = change.inserted + change.deleted;
    if (changes > 0) refresh_spacing(*level_);  // a new node has another's so far
    if (changes == 0 || changes >= max) break;
    max = changes;
  }
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
