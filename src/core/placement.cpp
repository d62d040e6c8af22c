// SPDX-License-Identifier: BSD-3-Clause
#include "core/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/kokkos_runtime.hpp"
#include "spacing/growth_limit.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

}  // namespace

void Placement::set_spacing(std::shared_ptr<const Spacing<2>> spacing) {
  spacing_ = std::move(spacing);
  spacing_replaced_ = true;
}

void Placement::set_nodes(std::vector<GivenNode> nodes) {
  given_ = std::move(nodes);
  start_from_given_ = true;
  level_.reset();
  nodes_changed();
}

void Placement::forget_nodes() {
  level_.reset();
  nodes_changed();
}

// ------------------------------------------------------------------ making a level -------------

void Placement::initialise() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  level_.reset();
  make_level();
}

// A level for the present spacing, with the present options.
void Placement::prepare_level() {
  const Settings settings(options_);
  if (!level_ || spacing_replaced_ || settings.growth_limit != level_->settings().growth_limit)
    make_level();
  else
    level_->change_settings(settings);
}

// Lays the boundary at the present spacing and puts in the inner nodes: those of the level before
// if there is one, those given, or a fill.
void Placement::make_level() {
  if (!spacing_)
    throw Error(PNPBS_ERROR_STATE,
                "the placement has no spacing yet: call one of the set_spacing functions first");
  domain_->check();
  const Settings settings(options_);
  std::shared_ptr<const Spacing<2>> spacing = spacing_;
  if (settings.growth_limit > 0) {
    const PhaseTimer timer(timers_, Phase::spacing);
    spacing = std::make_shared<GrowthLimitedSpacing>(*domain_, spacing_, settings.growth_limit,
                                                     settings.max_nodes);
  }
  // A copy: the caller may go on to change the domain.
  auto next =
      std::make_unique<Level>(std::make_shared<PlaneDomain>(*domain_), spacing, settings, timers_);
  next->lay_boundary_and_tree();
  std::int64_t left_out = 0;
  if (level_) {
    next->keep_boundary_ids(*level_);
    next->take(level_->inner_nodes());
  } else if (start_from_given_) {
    left_out = next->take(given_);
  } else {
    next->fill();
  }
  // Nothing has failed: from here on the new level counts.
  if (level_) rebuilds_before_ += level_->rebuilds();
  level_ = std::move(next);
  dropped_ = left_out;
  warnings_ = domain_->warnings();
  warnings_.insert(warnings_.end(), level_->boundary().warnings.begin(),
                   level_->boundary().warnings.end());
  spacing_replaced_ = false;
  begin_schedule();
  nodes_changed();
}

void Placement::begin_schedule() {
  schedule_step_ = 0;
  schedule_ended_ = false;
  population_settled_ = false;
  quiet_events_ = 0;
}

// ------------------------------------------------------------------ the time loop --------------

Outcome Placement::run() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  prepare_level();
  if (schedule_ended_) begin_schedule();
  const Outcome outcome = advance(level_->settings().steps, 0.95);
  schedule_ended_ = true;
  if (outcome != Outcome::stopped) finish();
  return outcome;
}

Outcome Placement::step(std::int64_t n) {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  prepare_level();
  if (schedule_ended_) begin_schedule();
  const std::int64_t until = schedule_step_ > kNoLimit - n ? kNoLimit : schedule_step_ + n;
  const Outcome outcome = advance(until, 1.0);
  if (level_->lists_may_miss_a_pair()) level_->rebuild_lists();
  return outcome;
}

// Steps on to step number `until` of the schedule, or until the bubbles rest. Events happen at
// step numbers fixed in advance. `share` is the part of the call's work that this is.
Outcome Placement::advance(std::int64_t until, double share) {
  const Settings& settings = level_->settings();
  const double first = static_cast<double>(schedule_step_);
  nodes_changed();
  Outcome outcome = Outcome::not_converged;
  stop_reason_ = StopReason::step_limit;
  while (schedule_step_ < until) {
    if (level_->lists_may_miss_a_pair()) level_->rebuild_lists();
    level_->move();
    ++schedule_step_;
    ++steps_done_;
    if (schedule_step_ % settings.event_interval != 0) continue;
    event();
    nodes_changed();
    const double done = (static_cast<double>(schedule_step_) - first) /
                        std::max(1.0, static_cast<double>(until) - first);
    if (monitor_stops(share * done)) {
      outcome = Outcome::stopped;
      stop_reason_ = StopReason::monitor;
      break;
    }
    if (bubbles_rest()) {
      outcome = Outcome::converged;
      stop_reason_ = StopReason::rest;
      break;
    }
  }
  return outcome;
}

// What happens at an event, in this order.
void Placement::event() {
  const Settings& settings = level_->settings();
  last_speeds_ = level_->speeds();
  last_speeds_.largest = comm_->largest(last_speeds_.largest);
  level_->refresh_spacing();
  if (schedule_step_ > settings.population_until) population_settled_ = true;
  if (!population_settled_) control_population();
}

// Adjusts the population while it pays. A new spacing may ask for many times the nodes there are,
// and one contest lets at most one act within two hops: so there are more rounds at once while
// they change much.
void Placement::control_population() {
  constexpr int kMostRounds = 12;
  constexpr double kMuch = 0.01;  // share of the nodes
  const double nodes = static_cast<double>(comm_->sum(static_cast<std::uint64_t>(count())));
  double changed = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const PopulationCounts change = count_population_change(level_->adjust_population());
    const double acted = static_cast<double>(change.inserted + change.deleted);
    changed += acted;
    if (acted < kMuch * nodes) break;
  }
  // Twice in a row: nodes that have just come may make room for more.
  quiet_events_ = changed <= level_->settings().population_pays * nodes ? quiet_events_ + 1 : 0;
  population_settled_ = quiet_events_ >= 2;
}

// While the population still changes, rest means nothing.
bool Placement::bubbles_rest() const {
  const Settings& settings = level_->settings();
  return population_settled_ && last_speeds_.mean < settings.tolerance_mean &&
         last_speeds_.largest < settings.tolerance_max;
}

bool Placement::monitor_stops(double fraction) {
  return monitor_ && monitor_(fraction, steps_done_, count(), last_speeds_.largest);
}

void Placement::finish() {
  const Settings& settings = level_->settings();
  if (settings.runge_kutta_finish) {
    if (level_->lists_may_miss_a_pair()) level_->rebuild_lists();
    level_->finish_by_runge_kutta();
    ++steps_done_;
  }
  level_->sweep(settings.sweeps);
  level_->refresh_spacing();
  nodes_changed();
  monitor_stops(1.0);
}

PopulationCounts Placement::adjust_population() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  prepare_level();
  nodes_changed();
  return count_population_change(level_->adjust_population());
}

PopulationCounts Placement::count_population_change(PopulationCounts change) {
  change.inserted =
      static_cast<std::int64_t>(comm_->sum(static_cast<std::uint64_t>(change.inserted)));
  change.deleted =
      static_cast<std::int64_t>(comm_->sum(static_cast<std::uint64_t>(change.deleted)));
  inserted_ += change.inserted;
  deleted_ += change.deleted;
  return change;
}

// ------------------------------------------------------------------ results --------------------

void Placement::nodes_changed() { fresh_ = Fresh::nothing; }

void Placement::prepare_order() {
  require_kokkos();
  if (!level_) throw Error(PNPBS_ERROR_STATE, "the placement has no nodes yet: call run first");
  if (fresh_ >= Fresh::order) return;
  const Nodes<2>& nodes = level_->nodes();
  by_id_.resize(static_cast<std::size_t>(nodes.count));
  std::iota(by_id_.begin(), by_id_.end(), 0);
  std::sort(by_id_.begin(), by_id_.end(),
            [&](std::int32_t a, std::int32_t b) { return nodes.id(a) < nodes.id(b); });
  place_.resize(by_id_.size());
  for (std::size_t p = 0; p < by_id_.size(); ++p)
    place_[static_cast<std::size_t>(by_id_[p])] = static_cast<std::int32_t>(p);
  fresh_ = Fresh::order;
}

void Placement::prepare_lists() {
  require_kokkos();
  if (!level_) throw Error(PNPBS_ERROR_STATE, "the placement has no nodes yet: call run first");
  if (fresh_ >= Fresh::lists) return;
  level_->rebuild_lists(level_->settings().adjacency_radius);
  fresh_ = Fresh::nothing;  // the nodes may have moved in memory
  prepare_order();
  fresh_ = Fresh::lists;
}

void Placement::prepare_stars() {
  prepare_lists();
  if (fresh_ >= Fresh::stars) return;
  level_->renew_stars();
  fresh_ = Fresh::stars;
}

// ------------------------------------------------------------------ statistics -----------------

NearestNeighbourError Placement::spacing_error() {
  prepare_lists();
  const Nodes<2>& nodes = level_->nodes();
  const AdjacencyList<2>& lists = level_->lists();
  // Nodes with no listed neighbour count as far as the lists reach.
  const auto ratio = [&](std::int64_t i) {
    double nearest = lists.radius() * nodes.d(i);
    lists.for_neighbours(i, [&](std::int64_t j) {
      nearest = std::min(nearest, distance<2>(nodes.position(i), nodes.position(j)));
    });
    return nearest / nodes.d(i);
  };
  const double n = static_cast<double>(comm_->sum(static_cast<std::uint64_t>(nodes.count)));
  const auto mean_of = [&](const auto& value) {
    const std::uint64_t sum = sum_of("pnpbs::spacing_error", nodes.count,
                                     [&](std::int64_t i) { return fixed_point(value(i)); });
    return from_fixed_point(comm_->sum(sum)) / n;
  };
  NearestNeighbourError error;
  error.mean = mean_of(ratio);
  error.deviation = std::sqrt(
      mean_of([&](std::int64_t i) { return (ratio(i) - error.mean) * (ratio(i) - error.mean); }));
  error.least = -comm_->largest(largest_of("pnpbs::spacing_error::least", nodes.count, -kFarAway,
                                           [&](std::int64_t i) { return -ratio(i); }));
  return error;
}

namespace {

// The finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::uint64_t bits(double value) {
  std::uint64_t b;
  std::memcpy(&b, &value, sizeof b);
  return b;
}

}  // namespace

// A sum over the nodes, so that it has no order.
std::uint64_t Placement::hash() const {
  if (!level_) return 0;
  const Nodes<2>& nodes = level_->nodes();
  return comm_->sum(sum_of("pnpbs::hash", nodes.count, [&](std::int64_t i) {
    std::uint64_t h = mix(static_cast<std::uint64_t>(nodes.id(i)));
    for (int k = 0; k < 2; ++k) h = mix(h ^ bits(nodes.x[k](i)));
    return mix(h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(nodes.tag(i))));
  }));
}

}  // namespace pnpbs
