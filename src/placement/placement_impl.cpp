// SPDX-License-Identifier: BSD-3-Clause
#include "placement/placement_impl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/kokkos_runtime.hpp"
#include "checkpoint/domain_fingerprint.hpp"
#include "checkpoint/option_changes.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/reach.hpp"
#include "method/constants.hpp"
#include "run/warnings.hpp"
#include "sizing/closing_patch.hpp"
#include "sizing/estimate.hpp"
#include "sizing/holding_spacing.hpp"
#include "spacing/nodal_spacing.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

}  // namespace

// ------------------------------------------------------------------ transactions ---------------

template <int Dim>
template <class Work>
auto PlacementImpl<Dim>::transaction(const Work& work) {
  PlacementBefore<Dim> before;
  collective_try(*comm_, [&] {
    before.state = now_;
    before.run = state_;
    if (now_.level) before.level = now_.level->copy();
  });
  before_ = &before;
  std::invoke_result_t<Work> result{};
  try {
    collective_try(*comm_, [&] { result = work(); });
  } catch (...) {
    before_ = nullptr;
    roll_back(before);
    throw;
  }
  before_ = nullptr;
  return result;
}

template <int Dim>
void PlacementImpl<Dim>::roll_back(PlacementBefore<Dim>& before) noexcept {
  before.restore_level();
  now_ = std::move(before.state);
  results_.show(now_.level.get());
  restore_run(std::move(before.run));
}

// ------------------------------------------------------------------ levels ---------------------

// Bubbles on a surface without a body interact as in the plane. Distances along a surface are not
// computed, so the growth of d is not limited there.
template <int Dim>
Settings PlacementImpl<Dim>::present_settings() const {
  Settings settings(options_, bubble_dimension(results_.kind()));
  if (results_.kind() == GeometryKind::surface) settings.growth_limit = 0;
  return settings;
}

// Ensures that there is a level for the present spacing and options. Returns `stopped` if the
// monitor stops its construction.
template <int Dim>
Outcome PlacementImpl<Dim>::prepare_level() {
  const Settings settings = present_settings();
  require_same_options();
  const bool make = !now_.level || now_.spacing_replaced ||
                    settings.growth_limit != now_.level->settings.growth_limit ||
                    settings.growth_limit_set != now_.level->settings.growth_limit_set ||
                    settings.resolve != now_.level->settings.resolve;
  if (comm_->allreduce_max(make) > 0) return make_level();
  now_.level->change_settings(settings);
  return Outcome::converged;
}

template <int Dim>
void PlacementImpl<Dim>::require_spacing() const {
  if (!now_.spacing.has_source())
    throw Error(ErrorKind::state,
                "the placement has no spacing yet: call one of the set_spacing functions first");
}

template <int Dim>
void PlacementImpl<Dim>::add_spacing_hints(const std::vector<Point<Dim>>& points) {
  collective_try(*comm_, [this] {
    require_spacing();
    domain_->check();
  });
  pnpbs::add_spacing_hints<Dim>(points, *comm_, *domain_, now_.spacing);
  now_.spacing_replaced = true;
}

// Returns the settings of a new level and updates now_.closed. Checks that there is a spacing, and
// that the domain is valid and the same on all ranks. All ranks must call it, and if one rank
// throws, all ranks throw.
template <int Dim>
Settings PlacementImpl<Dim>::settings_for_new_level() {
  require_spacing();
  Settings settings = present_settings();
  settings.max_bytes = bytes_allowed(*comm_, options_);
  collective_try(*comm_, [this] { domain_->check(); });
  require_same_domain(*comm_, *domain_);
  const double wanted = options_.real("wanted_nodes");
  collective_try(*comm_,
                 [&] { now_.closed = closed_before_sizing(domain_, now_.spacing, wanted); });
  return settings;
}

template <int Dim>
LevelBuilder<Dim> PlacementImpl<Dim>::builder() {
  const LevelContext<Dim> context{state_, monitoring_, results_, done_by_rounds(rounds_of_run_)};
  return {comm_, now_.closed, options_, timers_, context};
}

template <int Dim>
StartNodes<Dim> PlacementImpl<Dim>::start_nodes() const {
  return {now_.level.get(), start_from_given_ ? &given_ : nullptr};
}

template <int Dim>
Outcome PlacementImpl<Dim>::make_level() {
  const Settings settings = settings_for_new_level();
  PlacedSpacing<Dim> placed;
  if (now_.level) placed.held = now_.placed.held;
  if (now_.level && !now_.spacing_replaced) placed.count_factor = now_.placed.count_factor;
  LevelBuilder<Dim> builder = this->builder();
  std::shared_ptr<Level<Dim>> next = builder.level_to_place(placement_spacing(), settings, placed);
  return adopt(
      builder.with_first_nodes(std::move(next), std::move(placed), settings, start_nodes()));
}

// Installs a level whose construction has succeeded. The replaced level moves to `replaced`.
// Without `replaced` it returns to its state from the beginning of the call, for a later roll-back.
template <int Dim>
Outcome PlacementImpl<Dim>::adopt(BuiltLevel<Dim> made, std::shared_ptr<Level<Dim>>* replaced) {
  std::shared_ptr<Level<Dim>> before = replace_level(std::move(made.level), std::move(made.placed));
  if (replaced)
    *replaced = std::move(before);
  else
    before_->restore_level();
  state_.dropped = made.taken.left_out;
  state_.inserted += made.inserted;
  state_.deleted += made.taken.thinned;
  state_.schedule = Schedule();
  state_.schedule.first_nodes = made.first_nodes;
  return made.outcome;
}

template <int Dim>
void PlacementImpl<Dim>::release_present_nodes() {
  keep(nullptr);
  if (before_) before_->restore_level();
}

// Returns the replaced level.
template <int Dim>
std::shared_ptr<Level<Dim>> PlacementImpl<Dim>::replace_level(std::shared_ptr<Level<Dim>> next,
                                                              PlacedSpacing<Dim> placed) {
  std::vector<Warning> warnings =
      warnings_of_level(*next, *domain_, now_.spacing, placed.steepest, options_);
  std::shared_ptr<Level<Dim>> before = std::move(now_.level);
  if (before) state_.add_counts_of(*before);
  state_.forget_finish();
  keep(std::move(next));
  state_.warnings = std::move(warnings);
  state_.warnings_of_level = state_.warnings.size();
  now_.placed = std::move(placed);
  now_.level_options = options_;
  now_.spacing_replaced = false;
  return before;
}

// ------------------------------------------------------------------ calls ----------------------

template <int Dim>
Outcome PlacementImpl<Dim>::initialise() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::other);
  require_same_options();
  return transaction([this] {
    release_present_nodes();
    return retry_with_refined_tree([this] { return make_level(); });
  });
}

// Runs `work`, which changes nodes of the present level. Afterwards it migrates nodes to the ranks
// that own their positions, so that later requests for results change no owner.
template <int Dim>
template <class Work>
auto PlacementImpl<Dim>::with_exact_ghosts(const Work& work) {
  const auto result = work();
  if (!now_.level->ghosts.are_exact(now_.level->nodes, kStarHops)) exchange(*now_.level, kStarHops);
  return result;
}

// Runs `work`, which builds a level or takes steps on one. If nodes meet undersampled points of d,
// these are added to the spacing and the work is done again on a refined tree. It then starts from
// the present nodes if these were taken over from the user or an earlier level, and otherwise
// without nodes.
template <int Dim>
template <class Work>
Outcome PlacementImpl<Dim>::retry_with_refined_tree(const Work& work) {
  for (int tries = 1;; ++tries) {
    try {
      return work();
    } catch (const UndersampledSpacing& found) {
      if (tries == method::kMaxTreeTries) throw;
      if constexpr (Dim == 3) {
        add_undersampled_points(found, *comm_, *domain_, now_.spacing);
        now_.spacing_replaced = true;
      }
      if (!state_.schedule.taken_over()) release_present_nodes();
    }
  }
}

// Runs `steps` on a level for the present spacing. A schedule that has ended begins again.
template <int Dim>
template <class Steps>
Outcome PlacementImpl<Dim>::run_steps(const Steps& steps) {
  return transaction([&] {
    return retry_with_refined_tree([&] {
      if (prepare_level() == Outcome::stopped) return Outcome::stopped;
      return with_exact_ghosts([&] {
        if (state_.schedule.ended()) state_.schedule = state_.schedule.again();
        return steps();
      });
    });
  });
}

template <int Dim>
Outcome PlacementImpl<Dim>::run() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::other);
  struct Rounds {
    int& count;
    ~Rounds() { count = 0; }
  } rounds{rounds_of_run_};
  return run_steps([this] { return run_to_end(); });
}

template <int Dim>
Outcome PlacementImpl<Dim>::run_to_end() {
  Outcome outcome = repeat_with_reduced_spacing(steps_and_finish());
  if (outcome == Outcome::stopped) return outcome;
  if (now_.placed.count_factor == 1 && !state_.schedule.taken_over() && count_error() != 1)
    outcome = run_with_corrected_number();
  if (outcome == Outcome::stopped) return outcome;
  state_.outcome = outcome;
  if (!now_.placed.held.places.empty())
    state_.warn(warning_of_reduced_spacing(now_.placed.held, global_count()));
  monitoring_.stops(1.0, results_.count());
  return outcome;
}

// Returns the number of nodes over the requested number, or 1 if no correction is to be made. The
// latter is the case if no number is requested, if the two are so close that another run would not
// be closer, if they are so far apart that the vertices of the boundary must be the cause, or if d
// was reduced deliberately for the sake of the elements.
template <int Dim>
double PlacementImpl<Dim>::count_error() const {
  constexpr double kNear = 0.01, kFar = 0.25;
  const double wanted = options_.real("wanted_nodes");
  if (wanted == 0 || !now_.placed.held.places.empty()) return 1;
  const double error = static_cast<double>(global_count()) / wanted;
  return std::fabs(error - 1) <= kNear || std::fabs(error - 1) > kFar ? 1 : error;
}

// Repeats the run without start nodes, with d corrected by the error in the number of nodes. With
// start nodes, a slightly different d would not change their number. Collective.
template <int Dim>
Outcome PlacementImpl<Dim>::run_with_corrected_number() {
  const Settings settings = now_.level->settings;
  PlacedSpacing<Dim> placed;
  placed.count_factor = std::pow(count_error(), 1.0 / settings.bubble_dimension);
  ++rounds_of_run_;
  LevelBuilder<Dim> builder = this->builder();
  std::shared_ptr<Level<Dim>> next = builder.level_to_place(placement_spacing(), settings, placed);
  const Outcome begun =
      adopt(builder.with_first_nodes(std::move(next), std::move(placed), settings, {}));
  return begun == Outcome::stopped ? begun : repeat_with_reduced_spacing(steps_and_finish());
}

// Runs the time loop and the finish, and then checks the elements.
template <int Dim>
Outcome PlacementImpl<Dim>::steps_and_finish() {
  state_.forget_warnings_of_run();
  const ProgressPart part = part_of_steps(rounds_of_run_, state_.schedule.refined());
  const Outcome outcome = simulation().advance(max_steps(*now_.level), part);
  state_.schedule.progress = Progress::ended;
  if (outcome == Outcome::stopped) return outcome;
  if (simulation().finish(part.end) == Outcome::stopped) return Outcome::stopped;
  if (elements_cross_inner_surfaces(results_) &&
      simulation().follow_inner_surfaces(part.end) == Outcome::stopped)
    return Outcome::stopped;
  measure_finish(results_, now_.placed, state_);
  gather_unknown_uses(*now_.level, state_);
  state_.warn(warning_of_surface_fit(state_.surface_fit, options_));
  state_.warn(warning_of_features_left_out(*now_.level));
  const bool conforms = elements_conform(results_, state_, now_.unresolved);
  const std::optional<Warning> missed = warning_of_missed_spacing(state_.edge_bands);
  state_.warn(missed);
  return !conforms ? Outcome::not_conforming : missed ? Outcome::spacing_missed : outcome;
}

// Repeats the run with d reduced locally, as long as the elements do not conform or the number of
// small angles decreases. If a round that only improves angles is stopped or runs out of nodes or
// memory, the best earlier round is the result. Collective.
template <int Dim>
Outcome PlacementImpl<Dim>::repeat_with_reduced_spacing(Outcome first) {
  BestRound<Dim> best;
  Outcome outcome = first;
  while (outcome != Outcome::stopped) {
    FinishedRound<Dim> last{nullptr,
                            now_.placed,
                            state_,
                            outcome,
                            now_.unresolved.faults,
                            now_.unresolved.small_angles};
    if (!best.needs_another(last)) break;
    ++rounds_of_run_;
    const Outcome begun = reduce_spacing(outcome != Outcome::not_conforming, last.level);
    if (begun == Outcome::not_conforming) break;
    best.offer(std::move(last));
    const Monitoring::Provisional turns(monitoring_, best.any_conforms());
    try {
      outcome = begun == Outcome::stopped ? begun : steps_and_finish();
    } catch (const Error& error) {
      if (!best.any_conforms() || !is_lack_of_room(error)) throw;
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
Outcome PlacementImpl<Dim>::return_to(FinishedRound<Dim> round) {
  state_.add_counts_of(*now_.level);
  state_.go_back_to(std::move(round.state), *round.level);
  keep(std::move(round.level));
  // reported even if the first round is the result
  const double unresolved = now_.placed.held.least_before;
  now_.placed = std::move(round.placed);
  now_.placed.held.least_before = unresolved;
  return round.outcome;
}

// Begins a round in which d is reduced where the elements of the last one do not conform or have
// small angles. Returns `converged` if it has begun and `stopped` if the monitor stops it. Returns
// `not_conforming` and changes nothing if there is nothing to reduce, or if the round exceeds the
// limit of rounds or of nodes. Collective.
template <int Dim>
Outcome PlacementImpl<Dim>::reduce_spacing(bool conforms, std::shared_ptr<Level<Dim>>& replaced) {
  PlacedSpacing<Dim> placed = now_.placed;
  const RunState before = state_;
  Outcome outcome = Outcome::not_conforming;
  try {
    if (add_unresolved_points<Dim>(*now_.level, now_.unresolved, placed.held))
      outcome = begin_held_round(std::move(placed), conforms, replaced);
  } catch (const UndersampledSpacing&) {
    throw;  // retry_with_refined_tree() handles it
  } catch (const Error& error) {
    if (!is_lack_of_room(error)) throw;
    restore_run(before);
  }
  // These counts belong to the call as a whole, of which the round is a part.
  state_.dropped = before.dropped;
  state_.coarser_levels = before.coarser_levels;
  return outcome;
}

// Begins a round on a level for the reduced spacing, from the present nodes. Collective.
template <int Dim>
Outcome PlacementImpl<Dim>::begin_held_round(PlacedSpacing<Dim> placed, bool conforms,
                                             std::shared_ptr<Level<Dim>>& replaced) {
  const Settings settings = now_.level->settings;
  apply_local_reductions(*comm_, placed, settings);
  LevelBuilder<Dim> builder = this->builder();
  std::shared_ptr<Level<Dim>> next = builder.empty_level(placed.d, settings);
  const double expected = expected_nodes(*next);
  if (exceeds_node_growth(expected, placed.held, conforms)) {
    if (!conforms) state_.warn(warning_of_too_many(expected, placed.held));
    return Outcome::not_conforming;
  }
  placed.held.expected_nodes = std::max(static_cast<std::int64_t>(expected), global_count());
  settings.node_limit().require_memory_for(expected);
  return adopt(
      builder.with_first_nodes(std::move(next), std::move(placed), settings, start_nodes()),
      &replaced);
}

template <int Dim>
Outcome PlacementImpl<Dim>::step(std::int64_t n) {
  require_kokkos();
  if (!comm_->same_on_all(static_cast<std::uint64_t>(n)))
    throw Error(ErrorKind::argument, "argument n differs between ranks");
  const PhaseTimer timer(timers_, Phase::other);
  return run_steps([&] {
    const std::int64_t until =
        state_.schedule.step > kNoLimit - n ? kNoLimit : state_.schedule.step + n;
    return simulation().advance(until, {0, 1});
  });
}

template <int Dim>
Outcome PlacementImpl<Dim>::rebalance() {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::other);
  return transaction([this] {
    if (prepare_level() == Outcome::stopped) return Outcome::stopped;
    return with_exact_ghosts([this] {
      simulation().rebalance();
      return Outcome::converged;
    });
  });
}

template <int Dim>
Outcome PlacementImpl<Dim>::adjust_population(PopulationCounts& change) {
  require_kokkos();
  const PhaseTimer timer(timers_, Phase::other);
  const PopulationCounts before{state_.inserted, state_.deleted};
  const Outcome outcome = transaction([this] {
    const Outcome prepared = prepare_level();
    if (prepared != Outcome::stopped)
      with_exact_ghosts([this] { return simulation().adjust_population(); });
    return prepared;
  });
  change = {state_.inserted - before.inserted, state_.deleted - before.deleted};
  return outcome;
}

template <int Dim>
Estimate PlacementImpl<Dim>::estimate() {
  require_kokkos();
  require_same_options();
  const Settings settings = settings_for_new_level();  // updates now_.closed
  return estimate_of(placement_spacing(), settings);
}

// ------------------------------------------------------------------ checkpoints ----------------

template <int Dim>
void PlacementImpl<Dim>::require_savable() const {
  if (!now_.level) throw Error(ErrorKind::state, "the placement has no nodes yet: call run first");
  require_savable_spacing(now_.spacing_replaced, options_, now_.level_options);
}

template <int Dim>
Saved<Dim> PlacementImpl<Dim>::saved() {
  require_kokkos();
  require_same_options();
  collective_try(*comm_, [this] { require_savable(); });
  return saved_of(*now_.level, now_.placed, now_.spacing, state_, options_, monitoring_.at_event());
}

template <int Dim>
void PlacementImpl<Dim>::require_same_as(const SavedState& saved) {
  require_kokkos();
  require_same_options();
  pnpbs::require_same_as<Dim>(saved, *comm_, *domain_, options_);
}

template <int Dim>
void PlacementImpl<Dim>::restore(const SavedState& saved, std::vector<SavedNode<Dim>> nodes,
                                 Patch<Dim> patch) {
  const PhaseTimer timer(timers_, Phase::other);
  require_same_as(saved);
  transaction([&] {
    continue_from(saved, std::move(nodes), std::move(patch));
    return true;
  });
}

template <int Dim>
void PlacementImpl<Dim>::continue_from(const SavedState& saved, std::vector<SavedNode<Dim>> nodes,
                                       Patch<Dim> patch) {
  if (saved.spacing_saved)
    now_.spacing = field_from(
        std::make_shared<NodalSpacing<Dim>>(comm_, std::move(patch), domain_->embedding()));
  now_.spacing.set_undersampled_points(undersampled_points_of<Dim>(saved));
  const Settings settings = settings_for_new_level();
  PlacedSpacing<Dim> placed;
  LevelBuilder<Dim> builder = this->builder();
  std::shared_ptr<Level<Dim>> next =
      saved_level(saved, std::move(nodes), builder, placement_spacing(), settings, placed);
  replace_level(std::move(next), std::move(placed));
  before_->restore_level();
  adopt_state(saved, state_, *now_.level);
  adopt_changes(changes_since(saved.options, options_.in(Dim)));
}

template class PlacementImpl<2>;
template class PlacementImpl<3>;

}  // namespace pnpbs
