// SPDX-License-Identifier: BSD-3-Clause
// Making a level: checks, boundary, tree, growth limit, and the nodes it begins with.
#include <algorithm>

#include "base/error.hpp"
#include "level/expected_nodes.hpp"
#include "level/first_nodes.hpp"
#include "level/refinement.hpp"
#include "level/volume/gaps.hpp"
#include "placement/domain_fingerprint.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

// Bubbles on surfaces alone are those of the plane. Ways along a surface are not measured, so the
// growth of d is not limited there.
template <int Dim>
Settings PlacementOf<Dim>::present_settings() const {
  Settings settings(options_, results_.surfaces_alone() ? 2 : Dim);
  if (results_.surfaces_alone()) settings.growth_limit = 0;
  return settings;
}

// A level for the present spacing, with the present options. Stopped if the monitor has stopped
// what leads to it.
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

// Ranks with other options or another domain would wait for each other for ever.
void Placement::require_same_options() const {
  if (!comm_->same_on_all(options_.fingerprint()))
    throw Error(ErrorKind::argument,
                "the options differ between ranks: set the same ones on all of them");
}

template <int Dim>
void PlacementOf<Dim>::require_same_domain() const {
  if (!comm_->same_on_all(fingerprint_of(*domain_)))
    throw Error(ErrorKind::domain,
                "the domains differ between ranks: every rank describes the whole domain");
}

// Once spacing and domain are there, right, and the same on all ranks. Collective.
template <int Dim>
Settings PlacementOf<Dim>::settings_for_new_level() const {
  if (!spacing_)
    throw Error(ErrorKind::state,
                "the placement has no spacing yet: call one of the set_spacing functions first");
  Settings settings = present_settings();
  settings.max_bytes = bytes_allowed();
  agreed(*comm_, [this] { domain_->check(); });
  require_same_domain();
  return settings;
}

// A level without inner nodes yet, partitioned like another one if that is given.
template <int Dim>
std::unique_ptr<Level<Dim>> PlacementOf<Dim>::empty_level(
    std::shared_ptr<const Spacing<Dim>> spacing, const Settings& settings, const Level<Dim>* like) {
  std::unique_ptr<Level<Dim>> level;
  agreed(*comm_, [&] {
    const PhaseTimer timer(timers_, Phase::boundary);
    // A copy: the caller may go on to change the domain.
    level = std::make_unique<Level<Dim>>(comm_, std::make_shared<Domain<Dim>>(*domain_),
                                         std::move(spacing), settings, timers_);
  });
  level->grow_tree(like);
  return level;
}

// A level without nodes for the present spacing, whose growth is limited where the user wants it so
// or, by how steep it is, where nodes could not follow it.
template <int Dim>
std::unique_ptr<Level<Dim>> PlacementOf<Dim>::level_to_place(const Settings& settings,
                                                             PlacedSpacing<Dim>& placed) {
  placed.unheld = spacing_to_place(settings);
  const auto limit_growth = [&] {
    placed.unheld = growth_limited(std::move(placed.unheld), settings);
  };
  if (settings.user_limits_growth()) limit_growth();
  hold_down(placed, settings);
  std::unique_ptr<Level<Dim>> next = empty_level(placed.d, settings);
  if (!settings.user_limits_growth()) {
    const PhaseTimer timer(timers_, Phase::spacing);
    placed.steepest = steepest_growth<Dim>(
        *comm_, next->map(), [&](std::int32_t leaf) { return next->tree->owns(leaf); },
        next->ground.evaluator(), placed.unheld->known_values());
  }
  if (too_steep(placed.steepest) && settings.growth_limit > 0) {
    next.reset();
    limit_growth();
    hold_down(placed, settings);
    next = empty_level(placed.d, settings);
  }
  settings.node_limit().require_memory_for(expected_nodes(*next));
  return next;
}

template <int Dim>
Outcome PlacementOf<Dim>::make_level() {
  const Settings settings = settings_for_new_level();
  PlacedSpacing<Dim> placed;
  if (level_) placed.held = placed_.held;
  std::unique_ptr<Level<Dim>> next = level_to_place(settings, placed);
  return begin_on(std::move(next), std::move(placed), settings);
}

// Puts nodes on a level that has none: those of the level before, refined where it was coarser,
// those given, those that coarser levels lead to, or a fill. It is the level there is from then on.
template <int Dim>
Outcome PlacementOf<Dim>::begin_on(std::unique_ptr<Level<Dim>> next, PlacedSpacing<Dim> placed,
                                   const Settings& settings) {
  const std::shared_ptr<const Spacing<Dim>> spacing = placed.d;
  const bool taken_over = level_ || start_from_given_;
  next->held_rounds = placed.held.rounds;
  TakenNodes taken;
  std::int64_t inserted = 0;
  Outcome outcome = Outcome::converged;
  state_.coarser_levels = 0;
  state_.filled_level = 0;
  if (results_.surfaces_alone()) {
    if constexpr (Dim == 3) taken = begin_on_surfaces(*next, spacing, settings, outcome);
    inserted = taken.numbered;
  } else if (level_) {
    GivenNodes<Dim> kept = refined(*level_, *spacing);
    next->next_id = level_->next_id;
    if constexpr (Dim == 3) settle_surfaces(*next, kept, outcome);
    taken = take(*next, std::move(kept), next->next_id);
    // Where d was far larger, or the shape is thin.
    inserted = taken.numbered;
    if constexpr (Dim == 3) inserted += fill_gaps_inside(*next);
    taken.left_out = 0;  // not the user's
  } else if (start_from_given_) {
    GivenNodes<Dim> given = given_;
    if constexpr (Dim == 3) settle_surfaces(*next, given, outcome);
    taken = take(*next, std::move(given), next->next_id);
  } else {
    state_.filled_level = state_.coarser_levels = coarser_levels_that_pay(*next, spacing);
    if constexpr (Dim == 3)
      state_.coarser_levels = std::max(state_.coarser_levels, surface_levels_that_pay(*next));
    GivenNodes<Dim> nodes;
    if (state_.coarser_levels > 0)
      nodes = nodes_from_coarser_levels(*next, spacing, settings, outcome);
    put_first_nodes(*next, nodes, 0, outcome);
  }
  // Nothing has failed: from here on the new level counts.
  if (level_) state_.keep_counts(*level_);
  state_.forget_finish();
  keep(std::move(next));
  level_options_ = options_;
  state_.dropped = taken.left_out;
  state_.inserted += inserted;
  state_.deleted += taken.thinned;
  gather_warnings(placed.steepest);
  placed_ = std::move(placed);
  spacing_replaced_ = false;
  state_.schedule = Schedule();
  state_.schedule.first_nodes =
      first_nodes_of(state_.filled_level > 0, taken_over || outcome == Outcome::stopped);
  return outcome;
}

template <int Dim>
void PlacementOf<Dim>::gather_warnings(const SteepestGrowth<Dim>& steepest) {
  state_.warnings = domain_->warnings();
  state_.warnings.insert(state_.warnings.end(), level_->ground.warnings().begin(),
                         level_->ground.warnings().end());
  if (too_steep(steepest))
    state_.warnings.push_back(warning_of_growth(steepest, level_->settings.growth_limit));
  if (results_.surfaces_alone() && options_.is_set("growth_limit") &&
      options_.real("growth_limit") > 0)
    state_.warnings.push_back("the option growth_limit has no effect on surfaces alone");
  warn_of_partial_extent();
  if constexpr (Dim == 3) warn_of_coarse_spacing();
  state_.warnings_of_level = state_.warnings.size();
}

template <int Dim>
void PlacementOf<Dim>::fill(Level<Dim>& level, LaidNodes<Dim> laid) {
  monitoring_.watch("the first nodes were laid", results_.count(),
                    [&](const std::function<void()>& beat) {
                      pnpbs::fill(level, std::move(laid), beat, lattice_is_stretched());
                    });
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
