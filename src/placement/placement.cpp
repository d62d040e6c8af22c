// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/error.hpp"
#include "base/kokkos_runtime.hpp"
#include "level/exchange.hpp"
#include "level/finer_places.hpp"
#include "level/finer_region.hpp"
#include "level/reach.hpp"
#include "placement/placement_of.hpp"
#include "spacing/spacing_with_places.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

}  // namespace

template <int Dim>
void PlacementOf<Dim>::set_spacing(std::shared_ptr<const Spacing<Dim>> spacing) {
  spacing_ = std::move(spacing);
  spacing_replaced_ = true;
  placed_.held = {};
}

template <int Dim>
void PlacementOf<Dim>::set_nodes(GivenNodes<Dim> nodes) {
  given_ = std::move(nodes);
  start_from_given_ = true;
  keep(nullptr);
}

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
    if (!level_->ghosts.are_exact(level_->nodes, kStarHops<Dim>)) exchange(*level_, kStarHops<Dim>);
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
  constexpr int kMaxTries = 4;  // what is found shows its surroundings: two do, mostly
  for (int tries = 1;; ++tries) {
    try {
      return work();
    } catch (const FinerPlaces& found) {
      if (tries == kMaxTries) throw;
      if constexpr (Dim == 3) remember(found);
      if (!state_.schedule.taken_over()) keep(nullptr);
    }
  }
}

// As the spacing itself has them: on the level it may be multiplied by a factor.
template <>
void PlacementOf<3>::remember(const FinerPlaces& found) {
  agreed(*comm_, [&] {
    const SpacingEvaluator<3> raw = [&](std::int64_t n, const Point<3>* x, double* d) {
      evaluate_spacing<3>(*spacing_, measure_of(*domain_), n, x, d);
    };
    const auto inside = [&](const Point<3>& x) {
      return domain_->filled() && domain_->index().inside(x);
    };
    spacing_ =
        std::make_shared<SpacingWithPlaces<3>>(spacing_, finer_region(found.places(), raw, inside));
    spacing_replaced_ = true;
  });
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
    Outcome outcome = steps_and_finish();
    for (bool held = true; outcome == Outcome::not_conforming && held;) {
      ++rounds.count;
      const Outcome begun = hold_spacing();
      held = begun == Outcome::converged;
      outcome = held ? steps_and_finish() : begun;
    }
    if (outcome == Outcome::stopped) return outcome;
    warn_of_held_spacing();
    monitoring_.stops(1.0, results_.count());
    return outcome;
  });
}

// Of a run's work, what is done when a round with d held down begins. Each does half of the rest.
template <int Dim>
double PlacementOf<Dim>::done_by_rounds() const {
  return rounds_of_run_ == 0 ? 0 : 1 - std::ldexp(1 - kStepsShare, 1 - rounds_of_run_);
}

// Of a run's work, the part that its steps are: what has been done is not told again.
template <int Dim>
ProgressPart PlacementOf<Dim>::part_of_steps() const {
  const double done = done_by_rounds();
  if (rounds_of_run_ > 0) return {done, (done + 1) / 2};
  return {state_.schedule.refined() ? kCoarseShare : 0, kStepsShare};
}

// Ends with whether the elements are such as can be used.
template <int Dim>
Outcome PlacementOf<Dim>::steps_and_finish() {
  state_.warnings.resize(state_.warnings_of_level);
  const ProgressPart part = part_of_steps();
  const Outcome outcome = simulation().advance(level_->settings.steps, part);
  state_.schedule.progress = Progress::ended;
  if (outcome == Outcome::stopped) return outcome;
  if (simulation().finish(part.end) == Outcome::stopped) return Outcome::stopped;
  if constexpr (Dim == 3) measure_finish();
  gather_unknown_uses();
  warn_of_surface_fit();
  if constexpr (Dim == 3) warn_of_features_left_out();
  const bool conforms = elements_conform(), missed = spacing_missed();
  return !conforms ? Outcome::not_conforming : missed ? Outcome::spacing_missed : outcome;
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

// What was tried has failed: nothing is told of it but that a monitor has stopped it.
void Placement::put_back(const RunState& before) {
  const StopReason reason = state_.stop_reason;
  state_ = before;
  if (reason == StopReason::monitor) state_.stop_reason = reason;
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
