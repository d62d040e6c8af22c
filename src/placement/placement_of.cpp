// SPDX-License-Identifier: BSD-3-Clause
#include "placement/placement_of.hpp"

#include <limits>
#include <new>
#include <utility>

#include "base/kokkos_runtime.hpp"
#include "base/lack_of_room.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/reach.hpp"
#include "method/constants.hpp"
#include "placement/closing_patch.hpp"
#include "placement/domain_fingerprint.hpp"
#include "placement/estimate.hpp"
#include "placement/holding_spacing.hpp"
#include "placement/option_changes.hpp"
#include "placement/warnings.hpp"
#include "spacing/nodal_spacing.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

}  // namespace

// ------------------------------------------------------------------ levels ---------------------

// Bubbles on surfaces alone are those of the plane. Ways along a surface are not measured, so the
// growth of d is not limited there.
template <int Dim>
Settings PlacementOf<Dim>::present_settings() const {
  Settings settings(options_, results_.surfaces_alone() ? 2 : Dim);
  if (results_.surfaces_alone()) settings.growth_limit = 0;
  return settings;
}

// A level for the present spacing and options. Stopped if the monitor has stopped what leads to it.
template <int Dim>
Outcome PlacementOf<Dim>::prepare_level() {
  const Settings settings = present_settings();
  require_same_options();
  const bool make = !level_ || spacing_replaced_ ||
                    settings.growth_limit != level_->settings.growth_limit ||
                    settings.growth_limit_set != level_->settings.growth_limit_set ||
                    settings.resolve != level_->settings.resolve;
  if (comm_->allreduce_max(make) > 0) return make_level();
  level_->change_settings(settings);
  return Outcome::converged;
}

// Once spacing and domain are there, right, and the same on all ranks. Collective.
template <int Dim>
Settings PlacementOf<Dim>::settings_for_new_level() {
  if (!spacing_)
    throw Error(ErrorKind::state,
                "the placement has no spacing yet: call one of the set_spacing functions first");
  Settings settings = present_settings();
  settings.max_bytes = bytes_allowed(*comm_, options_);
  agreed(*comm_, [this] { domain_->check(); });
  require_same_domain(*comm_, *domain_);
  const double wanted = options_.real("wanted_nodes");
  agreed(*comm_, [&] { closed_ = closed_before_sizing(domain_, spacing_, wanted); });
  return settings;
}

template <int Dim>
LevelBuilder<Dim> PlacementOf<Dim>::builder() {
  const LevelContext<Dim> context{state_, monitoring_, results_, done_by_rounds(rounds_of_run_)};
  return {comm_, closed_, options_, timers_, context};
}

template <int Dim>
NodesBefore<Dim> PlacementOf<Dim>::nodes_before() const {
  return {level_.get(), start_from_given_ ? &given_ : nullptr};
}

template <int Dim>
Outcome PlacementOf<Dim>::make_level() {
  const Settings settings = settings_for_new_level();
  PlacedSpacing<Dim> placed;
  if (level_) placed.held = placed_.held;
  LevelBuilder<Dim> builder = this->builder();
  std::unique_ptr<Level<Dim>> next = builder.level_to_place(to_place(), settings, placed);
  return adopt(
      builder.with_first_nodes(std::move(next), std::move(placed), settings, nodes_before()));
}

// Nothing has failed: from here on the new level counts.
template <int Dim>
Outcome PlacementOf<Dim>::adopt(MadeLevel<Dim> made, std::unique_ptr<Level<Dim>>* replaced) {
  std::unique_ptr<Level<Dim>> before = replace_level(std::move(made.level), std::move(made.placed));
  if (replaced) *replaced = std::move(before);
  state_.dropped = made.taken.left_out;
  state_.inserted += made.inserted;
  state_.deleted += made.taken.thinned;
  state_.schedule = Schedule();
  state_.schedule.first_nodes = made.first_nodes;
  return made.outcome;
}

// Returns the one before.
template <int Dim>
std::unique_ptr<Level<Dim>> PlacementOf<Dim>::replace_level(std::unique_ptr<Level<Dim>> next,
                                                            PlacedSpacing<Dim> placed) {
  std::vector<Warning> warnings =
      warnings_of_level(*next, *domain_, *spacing_, placed.steepest, options_);
  std::unique_ptr<Level<Dim>> before = std::move(level_);
  if (before) state_.keep_counts(*before);
  state_.forget_finish();
  keep(std::move(next));
  state_.warnings = std::move(warnings);
  state_.warnings_of_level = state_.warnings.size();
  placed_ = std::move(placed);
  level_options_ = options_;
  spacing_replaced_ = false;
  return before;
}

// ------------------------------------------------------------------ calls ----------------------

template <int Dim>
Outcome PlacementOf<Dim>::initialise() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  require_same_options();
  std::unique_ptr<Level<Dim>> before = std::move(level_);
  results_.show(nullptr);
  const RunState state = state_;
  try {
    return knowing_finer_places([this] { return make_level(); });
  } catch (...) {
    keep(std::move(before));
    put_back(state);
    throw;
  }
}

// Changes the nodes there are. Afterwards every node is with the rank that owns its place, so that
// none changes its rank when it is asked for. A rank that ran out of memory may have lost some:
// then all let go of theirs.
template <int Dim>
template <class Work>
auto PlacementOf<Dim>::while_moving(const Work& work) {
  try {
    const auto result = work();
    if (!level_->ghosts.are_exact(level_->nodes, kStarHops)) exchange(*level_, kStarHops);
    return result;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::memory) keep(nullptr);
    throw;
  } catch (const std::bad_alloc&) {
    keep(nullptr);
    throw;
  }
}

// Does what makes a level, or takes steps on one. Where nodes come upon places that its tree was
// not made for, these are known from then on and it is done again: from the nodes there are, where
// these were taken over, else from nothing.
template <int Dim>
template <class Work>
Outcome PlacementOf<Dim>::knowing_finer_places(const Work& work) {
  for (int tries = 1;; ++tries) {
    try {
      return work();
    } catch (const FinerPlaces& found) {
      if (tries == method::kMaxTreeTries) throw;
      if constexpr (Dim == 3) {
        spacing_ = spacing_with(found, *comm_, *domain_, spacing_);
        spacing_replaced_ = true;
      }
      if (!state_.schedule.taken_over()) keep(nullptr);
    }
  }
}

// On a level for the present spacing, whose steps begin anew where they had ended.
template <int Dim>
template <class Steps>
Outcome PlacementOf<Dim>::taking_steps(const Steps& steps) {
  return knowing_finer_places([&] {
    if (prepare_level() == Outcome::stopped) return Outcome::stopped;
    return while_moving([&] {
      if (state_.schedule.ended()) state_.schedule = state_.schedule.again();
      return steps();
    });
  });
}

template <int Dim>
Outcome PlacementOf<Dim>::run() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  struct Rounds {
    int& count;
    ~Rounds() { count = 0; }
  } rounds{rounds_of_run_};
  return taking_steps([&] {
    const Outcome outcome = rounds_with_spacing_held(steps_and_finish());
    if (outcome == Outcome::stopped) return outcome;
    if (!placed_.held.places.empty())
      state_.warn(warning_of_held_spacing(placed_.held, global_count()));
    monitoring_.stops(1.0, results_.count());
    return outcome;
  });
}

// Ends with whether the elements are such as can be used.
template <int Dim>
Outcome PlacementOf<Dim>::steps_and_finish() {
  state_.forget_warnings_of_run();
  const ProgressPart part = part_of_steps(rounds_of_run_, state_.schedule.refined());
  const Outcome outcome = simulation().advance(most_steps(*level_), part);
  state_.schedule.progress = Progress::ended;
  if (outcome == Outcome::stopped) return outcome;
  if (simulation().finish(part.end) == Outcome::stopped) return Outcome::stopped;
  measure_finish(results_, placed_, state_);
  gather_unknown_uses(*level_, state_);
  state_.warn(warning_of_surface_fit(state_.surface_fit, options_));
  state_.warn(warning_of_features_left_out(*level_));
  const bool conforms = elements_conform(results_, state_, unresolved_);
  const std::optional<Warning> missed = warning_of_missed_spacing(state_.edge_bands);
  state_.warn(missed);
  return !conforms ? Outcome::not_conforming : missed ? Outcome::spacing_missed : outcome;
}

// Rounds after the first one, as long as the elements cannot be used, or fewer and fewer of them
// have small angles. Where one that is only to be better is stopped, or fails for want of room, the
// best one before it counts. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::rounds_with_spacing_held(Outcome first) {
  BestRound<Dim> best;
  Outcome outcome = first;
  while (outcome != Outcome::stopped && best.asks_for_another(outcome, unresolved_.small_angles)) {
    ++rounds_of_run_;
    FinishedRound<Dim> last{nullptr, placed_, state_, outcome, unresolved_.small_angles};
    const Outcome begun = hold_spacing(outcome != Outcome::not_conforming, last.level);
    if (begun == Outcome::not_conforming) break;
    best.offer(std::move(last));
    const Monitoring::Provisional turns(monitoring_, best.any_kept());
    try {
      outcome = begun == Outcome::stopped ? begun : steps_and_finish();
    } catch (const Error& error) {
      if (!best.any_kept() || !is_lack_of_room(error)) throw;
      return return_to(best.take());
    }
  }
  if (best.last_counts()) return outcome;
  const Outcome of_best = return_to(best.take());
  if (outcome != Outcome::stopped) return of_best;
  state_.stop_reason = StopReason::monitor;
  return Outcome::stopped;
}

template <int Dim>
Outcome PlacementOf<Dim>::return_to(FinishedRound<Dim> round) {
  state_.keep_counts(*level_);
  state_.go_back_to(std::move(round.state), *round.level);
  keep(std::move(round.level));
  placed_ = std::move(round.placed);
  return round.outcome;
}

// Begins a round with d held down where the last one does not conform or has small angles:
// converged, or stopped. Not conforming, as it is, if there is nothing to hold, it was tried often
// enough, or would take far more nodes than were asked for; then all stays as it is. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::hold_spacing(bool conforms, std::unique_ptr<Level<Dim>>& replaced) {
  PlacedSpacing<Dim> placed = placed_;
  const RunState before = state_;
  Outcome outcome = Outcome::not_conforming;
  try {
    if (add_unresolved_places<Dim>(*level_, unresolved_, placed.held))
      outcome = begin_held_round(std::move(placed), conforms, replaced);
  } catch (const FinerPlaces&) {
    throw;  // it is tried again with these
  } catch (const Error& error) {
    if (!is_lack_of_room(error)) throw;
    put_back(before);
  }
  // Of the call that the round belongs to.
  state_.dropped = before.dropped;
  state_.coarser_levels = before.coarser_levels;
  return outcome;
}

// On a level for the spacing as it is held now, with the nodes there were. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::begin_held_round(PlacedSpacing<Dim> placed, bool conforms,
                                           std::unique_ptr<Level<Dim>>& replaced) {
  const Settings settings = level_->settings;
  hold_down(*comm_, placed, settings);
  LevelBuilder<Dim> builder = this->builder();
  std::unique_ptr<Level<Dim>> next = builder.empty_level(placed.d, settings);
  const double expected = expected_nodes(*next);
  if (takes_too_many(expected, placed.held, conforms)) return Outcome::not_conforming;
  settings.node_limit().require_memory_for(expected);
  return adopt(
      builder.with_first_nodes(std::move(next), std::move(placed), settings, nodes_before()),
      &replaced);
}

template <int Dim>
Outcome PlacementOf<Dim>::step(std::int64_t n) {
  require_kokkos();
  if (!comm_->same_on_all(static_cast<std::uint64_t>(n)))
    throw Error(ErrorKind::argument, "argument n differs between ranks");
  const PhaseTimer timer(timers_, Phase::total);
  return taking_steps([&] {
    const std::int64_t until =
        state_.schedule.step > kNoLimit - n ? kNoLimit : state_.schedule.step + n;
    return simulation().advance(until, {0, 1});
  });
}

template <int Dim>
Outcome PlacementOf<Dim>::rebalance() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  if (prepare_level() == Outcome::stopped) return Outcome::stopped;
  return while_moving([this] {
    simulation().rebalance();
    return Outcome::converged;
  });
}

template <int Dim>
Outcome PlacementOf<Dim>::adjust_population(PopulationCounts& change) {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::total);
  const PopulationCounts before{state_.inserted, state_.deleted};
  const Outcome outcome = prepare_level();
  if (outcome != Outcome::stopped)
    while_moving([this] { return simulation().adjust_population(); });
  change = {state_.inserted - before.inserted, state_.deleted - before.deleted};
  return outcome;
}

template <int Dim>
Estimate PlacementOf<Dim>::estimate() {
  require_kokkos();
  require_same_options();
  const Settings settings = settings_for_new_level();  // sets closed_
  return estimate_of(to_place(), settings);
}

// ------------------------------------------------------------------ checkpoints ----------------

template <int Dim>
void PlacementOf<Dim>::require_savable() const {
  if (!level_) throw Error(ErrorKind::state, "the placement has no nodes yet: call run first");
  require_savable_spacing(spacing_replaced_, options_, level_options_);
}

template <int Dim>
Saved<Dim> PlacementOf<Dim>::saved() {
  require_kokkos();
  require_same_options();
  agreed(*comm_, [this] { require_savable(); });
  return saved_of(*level_, placed_.held, *spacing_, state_, options_, monitoring_.at_event());
}

template <int Dim>
void PlacementOf<Dim>::require_same_as(const SavedState& saved) {
  require_kokkos();
  require_same_options();
  pnpbs::require_same_as<Dim>(saved, *comm_, *domain_, options_);
}

template <int Dim>
void PlacementOf<Dim>::restore(const SavedState& state, std::vector<SavedNode<Dim>> nodes,
                               Patch<Dim> patch) {
  const PhaseTimer timer(timers_, Phase::total);
  require_same_as(state);
  const std::shared_ptr<const Spacing<Dim>> before = spacing_;
  try {
    if (state.spacing_saved)
      spacing_ = std::make_shared<NodalSpacing<Dim>>(comm_, std::move(patch), chart());
    const Settings settings = settings_for_new_level();
    PlacedSpacing<Dim> placed;
    LevelBuilder<Dim> builder = this->builder();
    std::unique_ptr<Level<Dim>> next =
        saved_level(state, std::move(nodes), builder, to_place(), settings, placed);
    replace_level(std::move(next), std::move(placed));
  } catch (...) {
    spacing_ = before;
    throw;
  }
  adopt_state(state, state_, *level_);
  adopt_changes(changes_since(state.options, options_.in(Dim)));
}

template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
