// SPDX-License-Identifier: BSD-3-Clause
#include "run/level_builder.hpp"

#include <algorithm>
#include <string>

#include "base/point_text.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/first_nodes.hpp"
#include "level/refinement.hpp"
#include "level/volume/gaps.hpp"
#include "run/settling_surfaces.hpp"
#include "run/simulation.hpp"
#include "sizing/closing_patch.hpp"
#include "sizing/coarser_levels.hpp"
#include "sizing/holding_spacing.hpp"
#include "sizing/periodic_copies.hpp"

namespace pnpbs {

namespace {

// Returns the nodes without their ids: all nodes of a level get new ids.
template <int Dim>
IncomingNodes<Dim> new_nodes(IncomingNodes<Dim> nodes) {
  for_each("pnpbs::new_nodes", static_cast<std::int64_t>(nodes.size()),
           [&](std::int64_t k) { nodes[static_cast<std::size_t>(k)].id = -1; });
  return nodes;
}

// Gives the domain of a coarser level the bounds of the finest one, so that the trees of both are
// partitioned alike. The smaller d is, the closer to the projection point a whole sphere is closed,
// and the larger its domain is in the chart.
void take_bounds(PlaneDomain& domain, const PlaneDomain& finer) {
  if (domain.is_whole_sphere()) domain.take_bounds(finer.bounds());
}
void take_bounds(VolumeDomain&, const VolumeDomain&) {}

// Makes nodes of the user those of a level. In a periodic domain, ids of the user are numbers of
// nodes, and points may lie outside of the cell.
template <int Dim>
void adopt_given(const Level<Dim>& level, IncomingNodes<Dim>& given) {
  constexpr std::int64_t kMaxNumber = std::int64_t{1} << 50;
  const PeriodicCell<Dim>& cell = level.nodes.cell;
  if (!cell.any()) return;
  for (IncomingNode<Dim>& node : given) {
    if (node.id > kMaxNumber)
      throw Error(ErrorKind::argument, "the id " + std::to_string(node.id) +
                                           " of a given node at " + point_text(node.position) +
                                           " must be in 0 .. 2^50, because the domain is periodic");
    if (node.id >= 0) node.id = cell.id_of(node.id);
    put_in_cell(level, node);
  }
}

}  // namespace

// ------------------------------------------------------------------ levels without nodes -------

template <int Dim>
std::shared_ptr<Level<Dim>> LevelBuilder<Dim>::empty_level(const SizingField<Dim>& spacing,
                                                           const Settings& settings,
                                                           const Level<Dim>* like) {
  std::shared_ptr<Level<Dim>> level;
  const auto make = [&] {
    const PhaseTimer timer(timers_, Phase::boundary);
    // The level needs a copy, because the caller may change the domain afterwards.
    auto domain =
        std::make_shared<Domain<Dim>>(*with_copies<Dim>(closed_domain(domain_, spacing), spacing));
    if (like) take_bounds(*domain, like->geometry.domain());
    level = std::make_shared<Level<Dim>>(comm_, std::move(domain),
                                         std::make_shared<const SizingField<Dim>>(spacing),
                                         settings, timers_);
  };
  context_.monitoring.watch("the boundary was laid and the tree grown", context_.results.count(),
                            [&] {
                              collective_try(*comm_, make);
                              level->grow_tree(domain_->cell().any() ? nullptr : like);
                            });
  return level;
}

template <int Dim>
std::shared_ptr<Level<Dim>> LevelBuilder<Dim>::level_to_place(
    const EffectiveSpacing<Dim>& placement_spacing, const Settings& settings,
    PlacedSpacing<Dim>& placed) {
  context_.monitoring.watch("the spacing was made", context_.results.count(), [&] {
    placed.d = placement_spacing.effective_spacing(settings, placed.count_factor);
    if (settings.user_limits_growth()) limit_growth(placement_spacing, placed.d, settings);
    apply_local_reductions(*comm_, placed, settings);
  });
  std::shared_ptr<Level<Dim>> next = empty_level(placed.d, settings);
  if (!settings.user_limits_growth() && !placed.steepest_is_known) {
    const PhaseTimer timer(timers_, Phase::spacing);
    placed.steepest = steepest_growth<Dim>(
        *comm_, next->map(), [&](std::int32_t leaf) { return next->tree->owns(leaf); },
        next->geometry.evaluator(), placed.d.without_reductions().spacing_hints(),
        domain_->embedding());
  }
  if (too_steep(placed.steepest) && settings.growth_limit > 0) {
    next.reset();
    context_.monitoring.watch("the growth of the spacing was limited", context_.results.count(),
                              [&] {
                                placed.d = placed.d.without_reductions();
                                limit_growth(placement_spacing, placed.d, settings);
                                apply_local_reductions(*comm_, placed, settings);
                              });
    next = empty_level(placed.d, settings);
  }
  settings.node_limit().require_memory_for(expected_nodes(*next));
  return next;
}

template <int Dim>
void LevelBuilder<Dim>::limit_growth(const EffectiveSpacing<Dim>& placement_spacing,
                                     SizingField<Dim>& spacing, const Settings& settings) {
  const PhaseTimer timer(timers_, Phase::spacing);
  placement_spacing.limit_growth(spacing, settings);
}

// ------------------------------------------------------------------ first nodes ----------------

template <int Dim>
BuiltLevel<Dim> LevelBuilder<Dim>::with_first_nodes(std::shared_ptr<Level<Dim>> level,
                                                    PlacedSpacing<Dim> placed,
                                                    const Settings& settings,
                                                    const StartNodes<Dim>& before) {
  BuiltLevel<Dim> made;
  made.level = std::move(level);
  made.placed = std::move(placed);
  made.level->held_rounds = made.placed.held.rounds;
  context_.run.coarser_levels = 0;
  filled_levels_ = 0;
  if (context_.results.kind() == GeometryKind::surface) {
    begin_on_surfaces(made, settings, before);
  } else if (before.level) {
    take_kept_nodes(made, *before.level);
  } else if (before.given) {
    take_given_nodes(made, *before.given);
  } else {
    begin_anew(made, settings);
  }
  const bool taken_over = before.level || before.given || made.outcome == Outcome::stopped;
  made.first_nodes = first_nodes_of(filled_levels_ > 0, taken_over);
  return made;
}

template <int Dim>
void LevelBuilder<Dim>::take_kept_nodes(BuiltLevel<Dim>& made, Level<Dim>& before) {
  Level<Dim>& level = *made.level;
  IncomingNodes<Dim> kept = refined(before, made.placed.d);
  level.next_id = before.next_id;
  settle_surfaces(level, kept, made.outcome, LevelRole::surfaces, context_);
  made.taken = take(level, std::move(kept), level.next_id);
  // Gaps remain where d was far larger before or the shape is thin.
  made.inserted = made.taken.numbered;
  made.inserted += fill_gaps_inside(level);
  made.taken.left_out = 0;  // the count is for nodes of the user only
}

template <int Dim>
void LevelBuilder<Dim>::take_given_nodes(BuiltLevel<Dim>& made, IncomingNodes<Dim> given) {
  Level<Dim>& level = *made.level;
  collective_try(*comm_, [&] { adopt_given(level, given); });
  settle_surfaces(level, given, made.outcome, LevelRole::surfaces, context_);
  made.taken = take(level, std::move(given), level.next_id);
}

template <int Dim>
void LevelBuilder<Dim>::begin_anew(BuiltLevel<Dim>& made, const Settings& settings) {
  int& coarser_levels = context_.run.coarser_levels;
  filled_levels_ = coarser_levels = useful_coarser_levels(*made.level, *domain_, made.placed.d);
  coarser_levels = std::max(coarser_levels, surface_levels_that_pay(*made.level));
  while (coarser_levels > 0 &&
         !periods_suffice<Dim>(*domain_, spacing_of_level(made.placed.d, coarser_levels)))
    --coarser_levels;
  IncomingNodes<Dim> nodes;
  if (coarser_levels > 0) nodes = nodes_from_coarser_levels(made, settings, made.outcome);
  put_first_nodes(*made.level, nodes, 0, made.outcome);
}

// Puts the first nodes on a level of a surface without a body: the nodes of the level before, the
// given nodes, or those from coarser levels.
template <int Dim>
void LevelBuilder<Dim>::begin_on_surfaces(BuiltLevel<Dim>& made, const Settings& settings,
                                          const StartNodes<Dim>& before) {
  if constexpr (Dim == 3) {
    IncomingNodes<3> nodes;
    ImportedNodes& taken = made.taken;
    if (before.level) {
      nodes = refined(*before.level, made.placed.d);
      made.level->next_id = before.level->next_id;
      taken.numbered = over_ranks(std::ranges::count(nodes, -1, &IncomingNode<3>::id));
    } else if (before.given) {
      nodes = *before.given;
      collective_try(*comm_, [&] { taken.left_out = bring_to_surfaces(*made.level, nodes); });
      taken.left_out = over_ranks(taken.left_out);
    } else {
      int& coarser_levels = context_.run.coarser_levels;
      filled_levels_ = coarser_levels = surface_levels_that_pay(*made.level);
      if (coarser_levels > 0) nodes = nodes_from_coarser_levels(made, settings, made.outcome);
    }
    taken.thinned = over_ranks(put_on_surfaces(*made.level, std::move(nodes)));
    made.inserted = taken.numbered;
  }
}

// Runs the coarser levels from the coarsest down to twice the spacing, each with its own
// simulation, and returns the refined nodes of the last. If the monitor stops them, the refined
// nodes are returned in their present state.
template <int Dim>
IncomingNodes<Dim> LevelBuilder<Dim>::nodes_from_coarser_levels(const BuiltLevel<Dim>& finest,
                                                                const Settings& settings,
                                                                Outcome& outcome) {
  const auto spacing_of = [&](int level) { return spacing_of_level(finest.placed.d, level); };
  RunState& run = context_.run;
  const int levels = run.coarser_levels;
  IncomingNodes<Dim> nodes;
  std::shared_ptr<Level<Dim>> coarser;
  const ScopedLevel<Dim> showing(context_.results, nullptr);
  for (int l = levels; l > 0; --l) {
    std::shared_ptr<Level<Dim>> level =
        empty_level(spacing_of(l), settings_of_level(settings, l == levels), finest.level.get());
    put_first_nodes(*level, nodes, l, outcome);
    if (coarser) run.add_counts_of(*coarser);
    run.forget_finish();
    coarser = std::move(level);
    context_.results.show(coarser.get());
    Schedule schedule;
    schedule.role = LevelRole::coarser;
    Simulation<Dim> simulation(*coarser, schedule, run, context_.monitoring);
    const ProgressPart part{kCoarseShare * (levels - l) / levels,
                            kCoarseShare * (levels - l + 1) / levels};
    if (outcome != Outcome::stopped && l <= filled_levels_)
      outcome = simulation.advance(coarser->settings.steps, part);
    if (outcome != Outcome::stopped && l <= filled_levels_) simulation.repair_defects();
    nodes = new_nodes<Dim>(refined(*coarser, spacing_of(l - 1)));
  }
  if (coarser) run.add_counts_of(*coarser);
  if (outcome != Outcome::stopped) outcome = Outcome::converged;
  return nodes;
}

// Puts the first nodes on one of several levels: the refined nodes of the level before or, on the
// first one, a fill. `which` is the number of the level, 0 for the finest.
template <int Dim>
void LevelBuilder<Dim>::put_first_nodes(Level<Dim>& level, IncomingNodes<Dim>& from_coarser,
                                        int which, Outcome& outcome) {
  if constexpr (Dim == 3) {
    if (context_.results.kind() == GeometryKind::surface) {
      put_on_surfaces(level, std::move(from_coarser));
      return;
    }
  }
  settle_surfaces(level, from_coarser, outcome,
                  which > 0 ? LevelRole::coarser : LevelRole::surfaces, context_);
  from_coarser = new_nodes<Dim>(std::move(from_coarser));
  level.next_id = 0;
  if (which > filled_levels_) return;  // only its surfaces have nodes
  if (which == filled_levels_) {
    fill(level, boundary_nodes(level.geometry, from_coarser));
    return;
  }
  take(level, std::move(from_coarser), 0);
  fill_gaps_inside(level);
}

template <int Dim>
void LevelBuilder<Dim>::fill(Level<Dim>& level, BoundaryNodes<Dim> laid) {
  context_.monitoring.watch("the first nodes were laid", context_.results.count(), [&] {
    pnpbs::fill(
        level, std::move(laid), [this] { context_.monitoring.beat(); },
        lattice_is_stretched(options_));
  });
}

template <int Dim>
std::int64_t LevelBuilder<Dim>::over_ranks(std::int64_t mine) const {
  return static_cast<std::int64_t>(comm_->allreduce_sum(static_cast<std::uint64_t>(mine)));
}

template class LevelBuilder<2>;
template class LevelBuilder<3>;

}  // namespace pnpbs
