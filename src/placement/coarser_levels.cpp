// SPDX-License-Identifier: BSD-3-Clause
// Multilevel bubble simulation: the first nodes of a level come from a coarser one, where what is
// wrong over long distances settles in cheap steps. Each level has twice the spacing of the next;
// to refine it, a node comes into the middle of every edge of its Delaunay stars, which leaves
// nearly every node with its six neighbours.
#include <cmath>

#include "initial/initial_fill.hpp"
#include "level/expected_nodes.hpp"
#include "level/refinement.hpp"
#include "level/taken_nodes.hpp"
#include "level/volume/gaps.hpp"
#include "placement/placement_of.hpp"
#include "spacing/multiplied_spacing.hpp"

namespace pnpbs {

namespace {

double coarser_by(int level) { return std::ldexp(1.0, level); }

template <int Dim>
std::shared_ptr<const Spacing<Dim>> spacing_of_level(
    const std::shared_ptr<const Spacing<Dim>>& spacing, int level) {
  if (level == 0) return spacing;
  return std::make_shared<MultipliedSpacing<Dim>>(spacing, coarser_by(level));
}

// All nodes of a level are numbered anew.
template <int Dim>
GivenNodes<Dim> new_nodes(GivenNodes<Dim> nodes) {
  for_each("pnpbs::new_nodes", static_cast<std::int64_t>(nodes.size()),
           [&](std::int64_t k) { nodes[static_cast<std::size_t>(k)].id = -1; });
  return nodes;
}

// A coarser level runs like a placement of its own; the coarsest has the most to settle. What
// is wrong there is wrong on every finer one, too.
Settings settings_of_level(Settings settings, bool coarsest) {
  constexpr double kPopulationShare = 0.75;
  // Of the finest level's tolerance: steps are cheap here.
  const double more_rest = settings.dimension == 2 ? 0.3 : 0.08;
  constexpr double kDenser = 0.997;  // in distance: refining leaves it a little too large
  settings.steps = coarsest ? settings.coarsest_steps : settings.refined_steps;
  settings.population_share = kPopulationShare;
  settings.defects.bad_below = 0;  // no triangle is handed on
  settings.tolerance_mean *= more_rest;
  settings.population.mean_distance *= kDenser;
  return settings;
}

}  // namespace

// None where d is nearly the same everywhere: then one lattice fills the domain. A level of few
// nodes has nothing to settle over long distances, and bubbles of a spacing that varies from one to
// the next have no rest. Collective, as the spacing is asked.
template <int Dim>
int PlacementOf<Dim>::coarser_levels_that_pay(
    const Level<Dim>& finest, const std::shared_ptr<const Spacing<Dim>>& spacing) const {
  constexpr double kMinNodes = 500;   // of the coarsest
  constexpr double kSteepest = 0.27;  // growth of d per unit of length
  const SpacingVariation d = spacing_variation(finest);
  const double nodes = expected_nodes(finest);
  int levels = 0;
  while (levels < finest.settings.levels && d.max > kPatchVariation * d.min &&
         nodes >= kMinNodes * std::pow(coarser_by(levels + 1), Dim) &&
         d.steepest * coarser_by(levels + 1) <= kSteepest &&
         boundary_leaves_room(finest, *spacing_of_level(spacing, levels + 1),
                              coarser_by(levels + 1), nodes))
    ++levels;
  return levels;
}

// Corners, the few nodes that a small hole needs, and fixed nodes are on every level, however
// coarse: where they are many among a level's nodes, it settles nothing, bubbles come and go
// between them, and each has dozens of edges near it. Of a coarser level with this spacing, is what
// its boundary has beyond its share of the finest one's little beside all of its nodes? (In space
// it is a matter of the surfaces, which settle before.)
template <int Dim>
bool PlacementOf<Dim>::boundary_leaves_room(const Level<Dim>& finest, const Spacing<Dim>& coarser,
                                            double factor, double nodes) const {
  if constexpr (Dim == 2) {
    constexpr double kMaxForced = 0.2;
    double laid = 0;
    agreed(*comm_, [&] {
      const SpacingEvaluator<2> checked = [&](std::int64_t n, const Point<2>* x, double* d) {
        evaluate_spacing<2>(coarser, measure_of(*domain_), n, x, d);
      };
      laid = static_cast<double>(discretize_boundary(*domain_, checked).nodes.size());
    });
    return laid - static_cast<double>(finest.ground.boundary_nodes()) / factor <=
           kMaxForced * (nodes / std::pow(factor, 2));
  }
  return true;
}

// From the coarsest level down to twice the spacing. If the monitor stops them, refined nodes are
// returned nevertheless, as they are.
template <int Dim>
GivenNodes<Dim> PlacementOf<Dim>::nodes_from_coarser_levels(
    const Level<Dim>& finest, const std::shared_ptr<const Spacing<Dim>>& spacing,
    const Settings& settings, Outcome& outcome) {
  GivenNodes<Dim> nodes;
  std::unique_ptr<Level<Dim>> coarser;
  const Showing<Dim> showing(results_, nullptr);
  for (int l = state_.coarser_levels; l > 0; --l) {
    std::unique_ptr<Level<Dim>> level =
        empty_level(spacing_of_level(spacing, l),
                    settings_of_level(settings, l == state_.coarser_levels), &finest);
    put_first_nodes(*level, nodes, l, outcome);
    if (coarser) state_.keep_counts(*coarser);
    state_.forget_finish();
    coarser = std::move(level);
    results_.show(coarser.get());
    Schedule schedule;
    schedule.role = LevelRole::coarser;
    Simulation<Dim> simulation(*coarser, schedule, state_, monitoring_);
    const ProgressPart part{kCoarseShare * (state_.coarser_levels - l) / state_.coarser_levels,
                            kCoarseShare * (state_.coarser_levels - l + 1) / state_.coarser_levels};
    if (outcome != Outcome::stopped && l <= state_.filled_level)
      outcome = simulation.advance(coarser->settings.steps, part);
    if (outcome != Outcome::stopped && l <= state_.filled_level) simulation.repair_defects();
    nodes = new_nodes<Dim>(refined(*coarser, *spacing_of_level(spacing, l - 1)));
  }
  if (coarser) state_.keep_counts(*coarser);
  if (outcome != Outcome::stopped) outcome = Outcome::converged;
  return nodes;
}

// The nodes that one of several levels begins with: those of the level before, refined, or on the
// first one a fill.
template <int Dim>
TakenNodes PlacementOf<Dim>::put_first_nodes(Level<Dim>& level, GivenNodes<Dim>& from_coarser,
                                             int which, Outcome& outcome) {
  if constexpr (Dim == 3) {
    if (results_.surfaces_alone()) {
      put_on_surfaces(level, std::move(from_coarser));
      return {};
    }
    settle_surfaces(level, from_coarser, outcome,
                    which > 0 ? LevelRole::coarser : LevelRole::surfaces);
    from_coarser = new_nodes<Dim>(std::move(from_coarser));
    level.next_id = 0;
  }
  if (which > state_.filled_level) return {};  // surfaces alone
  if (which == state_.filled_level) {
    fill(level, laid_nodes(level.ground, from_coarser));
    return {};
  }
  const TakenNodes taken = take(level, std::move(from_coarser), 0);
  if constexpr (Dim == 3) fill_gaps_inside(level);
  return taken;
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
