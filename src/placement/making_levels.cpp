// SPDX-License-Identifier: BSD-3-Clause
// Making a level: checks, boundary, tree, growth limit, and the nodes it begins with.
#include <algorithm>

#include "base/error.hpp"
#include "level/expected_nodes.hpp"
#include "level/first_nodes.hpp"
#include "level/refinement.hpp"
#include "placement/domain_fingerprint.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

// A level for the present spacing, with the present options. Stopped if the monitor has stopped
// what leads to it.
template <int Dim>
Outcome PlacementOf<Dim>::prepare_level() {
  const Settings settings(options_, Dim);
  require_same_options();
  const bool make = !level_ || spacing_replaced_ ||
                    settings.growth_limit != level_->settings.growth_limit ||
                    settings.growth_limit_set != level_->settings.growth_limit_set;
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
  Settings settings(options_, Dim);
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

// Lays the boundary at the present spacing and puts in the inner nodes: those of the level before,
// refined where it was coarser, those given, those that coarser levels lead to, or a fill.
template <int Dim>
Outcome PlacementOf<Dim>::make_level() {
  const Settings settings = settings_for_new_level();
  std::shared_ptr<const Spacing<Dim>> spacing = bounded_spacing();
  if (settings.user_limits_growth()) spacing = growth_limited(std::move(spacing), settings);
  std::unique_ptr<Level<Dim>> next = empty_level(spacing, settings);
  SteepestGrowth<Dim> steepest;  // none where the user limits it
  if (!settings.user_limits_growth()) {
    const PhaseTimer timer(timers_, Phase::spacing);
    steepest = steepest_growth<Dim>(
        *comm_, next->map(), [&](std::int32_t leaf) { return next->tree->owns(leaf); },
        next->ground.evaluator());
  }
  if (too_steep(steepest) && settings.growth_limit > 0) {
    next.reset();
    spacing = growth_limited(std::move(spacing), settings);
    next = empty_level(spacing, settings);
  }
  settings.node_limit().require_memory_for(expected_nodes(*next));
  TakenNodes taken;
  std::int64_t inserted = 0;
  Outcome outcome = Outcome::converged;
  coarser_levels_ = 0;
  filled_level_ = 0;
  if (level_) {
    GivenNodes<Dim> kept = refined(*level_, *spacing);
    next->next_id = level_->next_id;
    if constexpr (Dim == 3) settle_surfaces(next, kept, outcome);
    taken = take(*next, std::move(kept), next->next_id);
    taken.left_out = 0;  // not the user's
    inserted = taken.numbered;
  } else if (start_from_given_) {
    GivenNodes<Dim> given = given_;
    if constexpr (Dim == 3) settle_surfaces(next, given, outcome);
    taken = take(*next, std::move(given), next->next_id);
  } else {
    filled_level_ = coarser_levels_ = coarser_levels_that_pay(*next, spacing);
    if constexpr (Dim == 3)
      coarser_levels_ = std::max(coarser_levels_, surface_levels_that_pay(*next));
    GivenNodes<Dim> nodes;
    if (coarser_levels_ > 0) nodes = nodes_from_coarser_levels(*next, spacing, settings, outcome);
    put_first_nodes(next, nodes, 0, outcome);
  }
  // Nothing has failed: from here on the new level counts.
  adopt_level(std::move(next));
  dropped_ = taken.left_out;
  inserted_ += inserted;
  deleted_ += taken.thinned;
  warnings_ = domain_->warnings();
  warnings_.insert(warnings_.end(), level_->ground.warnings().begin(),
                   level_->ground.warnings().end());
  if (too_steep(steepest)) warnings_.push_back(warning_of_growth(steepest, settings.growth_limit));
  warnings_of_level_ = warnings_.size();
  spacing_replaced_ = false;
  begin_schedule(filled_level_ > 0);
  return outcome;
}

template <int Dim>
void PlacementOf<Dim>::fill(Level<Dim>& level, LaidNodes<Dim> laid) {
  while_monitored("the first nodes were laid", [&](const std::function<void()>& beat) {
    pnpbs::fill(level, std::move(laid), beat);
  });
}

template <int Dim>
void PlacementOf<Dim>::adopt_level(std::unique_ptr<Level<Dim>> next) {
  if (level_) {
    rebuilds_before_ += level_->neighbourhood.rebuilds();
    rebalances_before_ += level_->rebalances;
  }
  level_ = std::move(next);
  edge_bands_.clear();
  forget_results();
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
