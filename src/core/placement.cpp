// SPDX-License-Identifier: BSD-3-Clause
#include "core/placement.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>

#include "core/error.hpp"
#include "core/kokkos_runtime.hpp"
#include "core/mixed_hash.hpp"
#include "geometry/limits.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

// The nodes that are owned, or those that are not, in the order of their ids. These are nearly
// dense where a rank has them all; then no sort is needed.
void append_by_id(const Nodes<2>& nodes, bool owned, std::vector<std::int32_t>& order) {
  constexpr std::int64_t kDense = 4;  // ids to a node
  const auto first = static_cast<std::ptrdiff_t>(order.size());
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = -1;
  for (std::int32_t i = 0; i < nodes.count; ++i) {
    if ((nodes.owned(i) != 0) != owned) continue;
    order.push_back(i);
    least = std::min(least, nodes.id(i));
    most = std::max(most, nodes.id(i));
  }
  const auto begin = order.begin() + first;
  if (begin == order.end()) return;
  bool sort = most - least >= kDense * (order.end() - begin);
  if (!sort) {
    std::vector<std::int32_t> node_of(static_cast<std::size_t>(most - least + 1), -1);
    for (auto i = begin; i != order.end(); ++i) {
      std::int32_t& node = node_of[static_cast<std::size_t>(nodes.id(*i) - least)];
      sort = sort || node >= 0;  // two ranks were given the same id
      node = *i;
    }
    if (!sort)
      std::copy_if(node_of.begin(), node_of.end(), begin, [](std::int32_t i) { return i >= 0; });
  }
  if (sort)
    std::sort(begin, order.end(),
              [&](std::int32_t a, std::int32_t b) { return nodes.id(a) < nodes.id(b); });
}

// The steps' part of a run's work, for its progress: the rest are the finishing sweeps.
constexpr double kStepsShare = 0.9;

}  // namespace

void Placement::set_spacing(std::shared_ptr<const Spacing<2>> spacing) {
  spacing_ = std::move(spacing);
  spacing_replaced_ = true;
}

void Placement::set_nodes(GivenNodes nodes) {
  given_ = std::move(nodes);
  start_from_given_ = true;
  level_.reset();
}

void Placement::forget_nodes() { level_.reset(); }

// ------------------------------------------------------------------ making a level -------------

Outcome Placement::initialise() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  require_same_options();
  std::unique_ptr<Level> before = std::move(level_);
  try {
    return make_level();
  } catch (...) {
    level_ = std::move(before);
    throw;
  }
}

// A level for the present spacing, with the present options. Stopped if the monitor has stopped
// what leads to it.
Outcome Placement::prepare_level() {
  const Settings settings(options_);
  require_same_options();
  const bool make = !level_ || spacing_replaced_ ||
                    settings.growth_limit != level_->settings().growth_limit ||
                    settings.growth_limit_set != level_->settings().growth_limit_set;
  if (comm_->largest(make) > 0) return make_level();
  level_->change_settings(settings);
  return Outcome::converged;
}

// Ranks with other options or another domain would wait for each other for ever.
void Placement::require_same_options() const {
  if (!comm_->same_on_all(options_.fingerprint()))
    throw Error(PNPBS_ERROR_ARGUMENT,
                "the options differ between ranks: set the same ones on all of them");
}

void Placement::require_same_domain() const {
  std::uint64_t fingerprint = 0;
  const auto add = [&](double value) { fingerprint = mixed_with(fingerprint, value); };
  for (const BoundaryCurve& curve : domain_->curves()) {
    add(curve.tag);
    add(curve.left_inside);  // the role, and holes
    add(curve.right_inside);
    for (const Point<2>& x : curve.points)
      for (double coordinate : x) add(coordinate);
  }
  for (const Corner& corner : domain_->corners()) add(corner.tag);
  for (const FixedNode& node : domain_->fixed_nodes()) {
    add(node.tag);
    for (double coordinate : node.position) add(coordinate);
  }
  if (!comm_->same_on_all(fingerprint))
    throw Error(PNPBS_ERROR_DOMAIN,
                "the domains differ between ranks: every rank describes the whole domain");
}

// Once spacing and domain are there, right, and the same on all ranks. Collective.
Settings Placement::settings_for_new_level() const {
  if (!spacing_)
    throw Error(PNPBS_ERROR_STATE,
                "the placement has no spacing yet: call one of the set_spacing functions first");
  Settings settings(options_);
  settings.max_bytes = bytes_allowed();
  agreed(*comm_, [this] { domain_->check(); });
  require_same_domain();
  return settings;
}

// A level without inner nodes yet, dealt out to the ranks like another one if that is given.
std::unique_ptr<Level> Placement::empty_level(std::shared_ptr<const Spacing<2>> spacing,
                                              const Settings& settings, const Level* like) {
  std::unique_ptr<Level> level;
  agreed(*comm_, [&] {
    // A copy: the caller may go on to change the domain.
    level = std::make_unique<Level>(comm_, std::make_shared<PlaneDomain>(*domain_),
                                    std::move(spacing), settings, timers_);
    level->lay_boundary();
  });
  level->grow_tree(like);
  return level;
}

// Lays the boundary at the present spacing and puts in the inner nodes: those of the level before,
// refined where it was coarser, those given, those that coarser levels lead to, or a fill.
Outcome Placement::make_level() {
  const Settings settings = settings_for_new_level();
  std::shared_ptr<const Spacing<2>> spacing = bounded_spacing();
  if (settings.user_limits_growth()) spacing = growth_limited(std::move(spacing), settings);
  std::unique_ptr<Level> next = empty_level(spacing, settings);
  SteepestGrowth steepest;  // none where the user limits it
  if (!settings.user_limits_growth()) steepest = next->steepest_growth();
  if (too_steep(steepest) && settings.growth_limit > 0) {
    next.reset();
    spacing = growth_limited(std::move(spacing), settings);
    next = empty_level(spacing, settings);
  }
  settings.node_limit().require_memory_for(next->expected_nodes());
  TakenNodes taken;
  std::int64_t inserted = 0;
  Outcome outcome = Outcome::converged;
  coarser_levels_ = 0;
  if (level_) {
    taken = next->take(level_->refined(*spacing), level_->next_id());
    taken.left_out = 0;  // not the user's
    inserted = taken.numbered;
  } else if (start_from_given_) {
    taken = next->take(given_, 0);
  } else {
    coarser_levels_ = coarser_levels_that_pay(*next, spacing);
    if (coarser_levels_ > 0)
      next->take(nodes_from_coarser_levels(*next, spacing, settings, outcome), 0);
    else
      fill(*next);
  }
  // Nothing has failed: from here on the new level counts.
  adopt_level(std::move(next));
  dropped_ = taken.left_out;
  inserted_ += inserted;
  deleted_ += taken.thinned;
  warnings_ = domain_->warnings();
  warnings_.insert(warnings_.end(), level_->boundary().warnings.begin(),
                   level_->boundary().warnings.end());
  if (too_steep(steepest)) warnings_.push_back(warning_of_growth(steepest, settings.growth_limit));
  warnings_of_level_ = warnings_.size();
  spacing_replaced_ = false;
  begin_schedule(coarser_levels_ > 0);
  return outcome;
}

void Placement::fill(Level& level) {
  while_monitored("the first nodes were laid",
                  [&](const std::function<void()>& beat) { level.fill(beat); });
}

// Work that leads to first nodes, or to those of a new spacing, and takes long where they are many:
// it calls beat() again and again, so that this rank's monitor is asked by the clock. Where it
// stops, all ranks do, with the nodes there were before. Collective.
void Placement::while_monitored(const std::string& what,
                                const std::function<void(const std::function<void()>&)>& work) {
  const std::int64_t nodes = global_count();
  last_asked_ = Clock::now();
  try {
    work([&] {
      if (!monitor_is_due()) return;
      last_asked_ = Clock::now();
      if (asks_to_stop(0, nodes))
        throw Error(PNPBS_STOPPED, "stopped by the monitor while " + what);
    });
  } catch (const Error& error) {
    if (error.status() == PNPBS_STOPPED) stop_reason_ = StopReason::monitor;
    throw;
  }
}

void Placement::adopt_level(std::unique_ptr<Level> next) {
  if (level_) {
    rebuilds_before_ += level_->rebuilds();
    rebalances_before_ += level_->rebalances();
  }
  level_ = std::move(next);
  order_version_ = lists_version_ = stars_version_ = quality_version_ = -1;
}

void Placement::begin_schedule(bool refined) {
  schedule_ = Schedule();
  schedule_.refined = refined;
}

// ------------------------------------------------------------------ the time loop --------------

// Changes the nodes there are. Afterwards every node is with the rank that owns its place, so that
// none changes its rank when it is asked for. A rank that ran out of memory may have lost some:
// then all let go of theirs.
template <class Work>
auto Placement::while_moving(const Work& work) {
  try {
    const auto result = work();
    level_->exchange_for_stars();
    return result;
  } catch (const Error& error) {
    if (error.status() == PNPBS_ERROR_MEMORY) level_.reset();
    throw;
  } catch (const std::bad_alloc&) {
    level_.reset();
    throw;
  }
}

Outcome Placement::run() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  if (prepare_level() == Outcome::stopped) return Outcome::stopped;
  return while_moving([this] {
    if (schedule_.ended) begin_schedule(false);
    warnings_.resize(warnings_of_level_);
    const Outcome outcome =
        advance(level_->settings().steps, {schedule_.refined ? kCoarseShare : 0, kStepsShare});
    schedule_.ended = true;
    if (outcome == Outcome::stopped) return outcome;
    if (finish() == Outcome::stopped) return Outcome::stopped;
    return spacing_missed() ? Outcome::spacing_missed : outcome;
  });
}

Outcome Placement::step(std::int64_t n) {
  require_kokkos();
  if (!comm_->same_on_all(static_cast<std::uint64_t>(n)))
    throw Error(PNPBS_ERROR_ARGUMENT, "argument n differs between ranks");
  const PhaseTimer timer(timers_, Phase::total);
  if (prepare_level() == Outcome::stopped) return Outcome::stopped;
  return while_moving([&] {
    if (schedule_.ended) begin_schedule(false);
    const std::int64_t until = schedule_.step > kNoLimit - n ? kNoLimit : schedule_.step + n;
    return advance(until, {0, 1});
  });
}

// Steps on to step number `until` of the schedule, or until the bubbles rest. Events happen at
// step numbers fixed in advance. `part` is the part of the call's work that this is.
Outcome Placement::advance(std::int64_t until, ProgressPart part) {
  const Settings& settings = level_->settings();
  const double first = static_cast<double>(schedule_.step);
  Outcome outcome = Outcome::not_converged;
  stop_reason_ = StopReason::step_limit;
  std::exception_ptr failure;  // of this rank: told to the others at the next event
  bool started = true;
  while (schedule_.step < until) {
    if (started || schedule_.step % settings.event_interval % settings.exchange_interval == 0)
      level_->exchange_for_steps(failure);
    started = false;
    try {
      if (!failure && level_->lists_may_miss_a_pair()) level_->rebuild_lists();
      if (!failure) level_->move();
    } catch (...) {
      failure = std::current_exception();
    }
    level_->count_step();
    ++schedule_.step;
    ++steps_done_;
    const bool is_event = schedule_.step % settings.event_interval == 0;
    if (is_event || schedule_.step == until || !level_->distributed())
      agree_on_failure(*comm_, failure);
    const double done = (static_cast<double>(schedule_.step) - first) /
                        std::max(1.0, static_cast<double>(until) - first);
    const double fraction = part.begin + done * (part.end - part.begin);
    if (is_event) event();
    if (is_event ? monitor_stops(fraction) : stops_between_events(fraction)) {
      if (!is_event) level_->refresh_spacing();  // as d is at the nodes now
      outcome = Outcome::stopped;
      stop_reason_ = StopReason::monitor;
      break;
    }
    if (is_event && bubbles_rest()) {
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
  level_->refresh_spacing();
  const double population_until =
      std::floor(settings.population_share * static_cast<double>(settings.steps));
  if (static_cast<double>(schedule_.step) > population_until && !far_too_few())
    schedule_.population_settled = true;
  if (!schedule_.population_settled)
    control_population();  // renews the ghosts, too; else the next step does
  keep_balance();
}

// Deals the work out anew where it has become unequal, unless it was no better after the last time.
void Placement::keep_balance() {
  if (!level_->distributed()) return;
  constexpr double kNoBetter = 1.02;
  const double imbalance = level_->imbalance();
  if (imbalance <=
      std::max(level_->settings().rebalance_above, kNoBetter * schedule_.imbalance_reached))
    return;
  rebalance_now();
}

void Placement::rebalance_now() {
  level_->rebalance();
  schedule_.imbalance_reached = level_->imbalance();
}

void Placement::rebalance() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  prepare_level();
  rebalance_now();
}

// Nodes given from outside may be so few that they take longer to multiply.
bool Placement::far_too_few() const {
  return static_cast<double>(global_count()) < 0.85 * level_->expected_nodes();
}

// Adjusts the population while it pays, the first time aimed at the mean distance. A new spacing
// may ask for many times the nodes there are, and one contest lets at most one act within three
// hops: so there are more rounds at once while they change much.
void Placement::control_population() {
  constexpr int kMostRounds = 20;
  constexpr double kMuch = 0.002;     // share of the nodes
  constexpr double kRefinedPays = 5;  // times the option's share
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // What is off on a coarser level is off on all finer ones; on the finest each change costs steps.
  const double tolerance = (schedule_.coarser ? 1 : 3) * kMeanTolerance;
  const double nodes = static_cast<double>(global_count());
  double changed = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const PopulationCounts change =
        count_population_change(level_->adjust_population(round == 0 ? tolerance : kInfinity));
    const double acted = static_cast<double>(change.inserted + change.deleted);
    changed += acted;
    if (acted < kMuch * nodes) break;
  }
  const Settings& settings = level_->settings();
  // Nodes that have just come may make room for more: so twice in a row. After a coarser level
  // there is little left to do.
  const bool quiet =
      changed <= (schedule_.refined ? kRefinedPays : 1) * settings.population_pays * nodes;
  schedule_.quiet_events = quiet ? schedule_.quiet_events + 1 : 0;
  schedule_.population_settled =
      schedule_.quiet_events >= (schedule_.refined ? 1 : 2) && !far_too_few();
}

// While the population still changes, rest means nothing.
bool Placement::bubbles_rest() const {
  const Settings& settings = level_->settings();
  return schedule_.population_settled && last_speeds_.mean < settings.tolerance_mean &&
         last_speeds_.largest < settings.tolerance_max;
}

// All stop if one rank's monitor asks for it.
bool Placement::monitor_stops(double fraction) {
  bool stop = false;
  const std::int64_t nodes = global_count();
  agreed(*comm_, [&] { stop = asks_to_stop(fraction, nodes); });
  last_asked_ = Clock::now();
  return comm_->largest(stop) > 0;
}

// Has this rank's monitor not been asked for a while?
bool Placement::monitor_is_due() const {
  constexpr auto kBetweenCalls = std::chrono::milliseconds(200);
  return monitor_ && Clock::now() - last_asked_ >= kBetweenCalls;
}

// The same of work that takes long only where nodes are many. All ranks ask, or none: a monitor may
// ask for what is collective.
bool Placement::monitor_stops_by_clock(double fraction) {
  return comm_->largest(monitor_is_due()) > 0 && monitor_stops(fraction);
}

// The steps between two events of ten million nodes take some seconds. Several ranks have fewer
// nodes each, and would have to agree every time: they are asked at events.
bool Placement::stops_between_events(double fraction) {
  return !level_->distributed() && monitor_is_due() && monitor_stops(fraction);
}

// Each part of it leaves valid nodes.
Outcome Placement::finish() {
  const Settings& settings = level_->settings();
  const auto stops = [this] {
    if (!monitor_stops_by_clock(kStepsShare)) return false;
    level_->refresh_spacing();
    stop_reason_ = StopReason::monitor;
    return true;
  };
  if (settings.runge_kutta_finish) {
    level_->exchange_for_runge_kutta();
    agreed(*comm_, [this] {
      level_->rebuild_lists();  // its stages look ahead
      level_->finish_by_runge_kutta();
    });
    level_->count_step();
    ++steps_done_;
  }
  repair_defects();
  if (stops()) return Outcome::stopped;
  count_population_change(level_->remove_crowded());
  if (stops()) return Outcome::stopped;
  count_population_change(level_->sweep_and_repair(settings.sweeps));
  level_->refresh_spacing();
  monitor_stops(1.0);
  return Outcome::converged;
}

// Where a node is one too many or one is missing that the overlap ratios do not tell. Nodes that
// coincide would have no star, so they go first. Rounds must do less and less: where d jumps, what
// one brings another may take away, for ever.
void Placement::repair_defects() {
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t round = 0; round < level_->settings().defects.rounds && most > 1; ++round) {
    count_population_change(level_->remove_crowded());
    const PopulationCounts change = count_population_change(level_->repair_defects());
    const std::int64_t changes = change.inserted + change.deleted;
    if (changes > 0) level_->refresh_spacing();  // a new node has another's so far
    if (changes == 0 || changes >= most) break;
    most = changes;
  }
}

PopulationCounts Placement::adjust_population() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  const PopulationCounts before{inserted_, deleted_};
  prepare_level();
  while_moving([this] { return count_population_change(level_->adjust_population()); });
  return {inserted_ - before.inserted, deleted_ - before.deleted};
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

std::int64_t Placement::count() const { return level_ ? level_->owned_count() : 0; }

std::int64_t Placement::global_count() const {
  return static_cast<std::int64_t>(comm_->sum(static_cast<std::uint64_t>(count())));
}

void Placement::prepare_order() {
  require_kokkos();
  if (!level_) throw Error(PNPBS_ERROR_STATE, "the placement has no nodes yet: call run first");
  if (order_version_ == level_->version()) return;
  // Owned nodes first, then ghosts, each by id.
  const Nodes<2>& nodes = level_->nodes();
  by_id_.clear();
  by_id_.reserve(static_cast<std::size_t>(nodes.count));
  append_by_id(nodes, true, by_id_);
  append_by_id(nodes, false, by_id_);
  place_.resize(by_id_.size());
  for (std::size_t p = 0; p < by_id_.size(); ++p)
    place_[static_cast<std::size_t>(by_id_[p])] = static_cast<std::int32_t>(p);
  order_version_ = level_->version();
}

void Placement::prepare_lists() {
  require_kokkos();
  if (!level_) throw Error(PNPBS_ERROR_STATE, "the placement has no nodes yet: call run first");
  if (lists_version_ == level_->version()) return;
  level_->prepare_lists();
  prepare_order();
  lists_version_ = level_->version();
  if (level_->distributed()) stars_version_ = lists_version_;
}

void Placement::prepare_stars() {
  prepare_lists();
  if (stars_version_ == level_->version()) return;
  level_->renew_stars();
  stars_version_ = level_->version();
}

ExchangePattern Placement::exchange_pattern() {
  prepare_lists();
  const Nodes<2>& nodes = level_->nodes();
  const std::int64_t owned = count();
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owners;
  for (std::int64_t place = 0; place < nodes.count; ++place) {
    ids.push_back(nodes.id(node_at(place)));
    if (place >= owned) owners.push_back(level_->owner_of(node_at(place)));
  }
  return make_exchange_pattern(*comm_, owned, ids, owners);
}

std::int64_t Placement::nodes_on_ranks_before() const {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(comm_->size()), 0);
  counts[static_cast<std::size_t>(comm_->rank())] = count();
  comm_->sum(counts);
  return std::accumulate(counts.begin(), counts.begin() + comm_->rank(), std::int64_t{0});
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
  const double n = static_cast<double>(global_count());
  const auto mean_of = [&](const auto& value) {
    const std::uint64_t sum = sum_of("pnpbs::spacing_error", nodes.count, [&](std::int64_t i) {
      return nodes.owned(i) ? fixed_point(value(i)) : 0;
    });
    return from_fixed_point(comm_->sum(sum)) / n;
  };
  NearestNeighbourError error;
  error.mean = mean_of(ratio);
  error.deviation = std::sqrt(
      mean_of([&](std::int64_t i) { return (ratio(i) - error.mean) * (ratio(i) - error.mean); }));
  error.least = -comm_->largest(
      largest_of("pnpbs::spacing_error::least", nodes.count, -kFarAway,
                 [&](std::int64_t i) { return nodes.owned(i) ? -ratio(i) : -kFarAway; }));
  return error;
}

// A sum over the nodes, so that it has no order.
std::uint64_t Placement::hash() const {
  if (!level_) return 0;
  const Nodes<2>& nodes = level_->nodes();
  return comm_->sum(sum_of("pnpbs::hash", nodes.count, [&](std::int64_t i) -> std::uint64_t {
    if (!nodes.owned(i)) return 0;
    std::uint64_t h = mixed(static_cast<std::uint64_t>(nodes.id(i)));
    for (int k = 0; k < 2; ++k) h = mixed_with(h, nodes.x[k](i));
    return mixed(h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(nodes.tag(i))));
  }));
}

}  // namespace pnpbs
