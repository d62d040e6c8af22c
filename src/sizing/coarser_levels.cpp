// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/coarser_levels.hpp"

#include <cmath>

#include "initial/initial_fill.hpp"
#include "level/expected_nodes.hpp"
#include "method/constants.hpp"
#include "sizing/closing_patch.hpp"
#include "sizing/periodic_copies.hpp"

namespace pnpbs {

namespace {

// Returns the number of boundary nodes without the patch of a whole sphere. Each level has its own
// patch, which is at rest from the start.
double boundary_nodes(const PlaneDomain& domain, std::size_t all) {
  return static_cast<double>(static_cast<std::int64_t>(all) - domain.patch_nodes());
}

double coarser_by(int level) { return std::ldexp(1.0, level); }

// Returns whether the boundary nodes of a coarser level are few compared with all its nodes, except
// for their share of those of the finest level. Corners, nodes of small holes and fixed nodes are
// on every level. If they are many, the level settles nothing, its population fluctuates, and each
// node has dozens of edges near it. In space surfaces settle first, and this criterion does not
// apply.
bool boundary_leaves_room(const Level<2>& finest, const PlaneDomain& domain,
                          const Spacing<2>& coarser, double factor, double nodes) {
  double laid = 0;
  collective_try(*finest.comm, [&] {
    const SpacingEvaluator<2> checked = [&](std::int64_t n, const Point<2>* x, double* d) {
      evaluate_spacing<2>(coarser, measure_of(domain), n, x, d);
    };
    laid = boundary_nodes(domain, discretize_boundary(domain, checked).nodes.size());
  });
  const LevelGeometry<2>& geometry = finest.geometry;
  return laid - boundary_nodes(geometry.domain(), geometry.boundary().nodes.size()) / factor <=
         method::kMaxForced * (nodes / std::pow(factor, 2));
}
bool boundary_leaves_room(const Level<3>&, const VolumeDomain&, const Spacing<3>&, double, double) {
  return true;
}

}  // namespace

template <int Dim>
SizingField<Dim> spacing_of_level(const SizingField<Dim>& spacing, int level) {
  return spacing.coarsened(coarser_by(level));
}

Settings settings_of_level(Settings settings, bool coarsest) {
  // Factor on the tolerance of the finest level, since steps are cheap on coarser ones.
  const double more_rest =
      settings.bubble_dimension == 2 ? method::kCoarserRestInPlane : method::kCoarserRestInSpace;
  settings.steps = coarsest ? settings.coarsest_steps : settings.refined_steps;
  settings.population_share = method::kCoarserPopulationShare;
  settings.defects.bad_below = 0;  // no triangle of this level is in the result
  settings.tolerance_mean *= more_rest;
  if (settings.bubble_dimension == 3)
    settings.population.mean_distance *= method::kCoarserDistanceInSpace;
  return settings;
}

template <int Dim>
int useful_coarser_levels(const Level<Dim>& finest, const Domain<Dim>& domain,
                          const SizingField<Dim>& spacing) {
  const SpacingVariation d = spacing_variation(finest);
  const double nodes = expected_nodes(finest);
  int levels = 0;
  const auto pays = [&](const Spacing<Dim>& coarser, double factor) {
    return d.max > method::kPatchVariation * d.min &&
           nodes >= method::kMinNodesOfCoarsest * std::pow(factor, Dim) &&
           d.steepest * factor <= method::kSteepestOnCoarsest && can_be_closed(domain, coarser) &&
           periods_suffice(domain, coarser) &&
           boundary_leaves_room(finest, domain, coarser, factor, nodes);
  };
  while (levels < finest.settings.levels &&
         pays(spacing_of_level(spacing, levels + 1), coarser_by(levels + 1)))
    ++levels;
  return levels;
}

template int useful_coarser_levels(const Level<2>&, const PlaneDomain&, const SizingField<2>&);
template int useful_coarser_levels(const Level<3>&, const VolumeDomain&, const SizingField<3>&);
template SizingField<2> spacing_of_level(const SizingField<2>&, int);
template SizingField<3> spacing_of_level(const SizingField<3>&, int);

}  // namespace pnpbs
