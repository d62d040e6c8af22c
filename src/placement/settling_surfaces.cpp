// SPDX-License-Identifier: BSD-3-Clause
// In space, what has the least freedom comes first: nodes on feature edges lie where d asks for
// them, those on surfaces rest as bubbles that cannot leave their surface, and then the inside is
// filled. On every level the same loop of steps and events moves one after the other.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/clearance.hpp"
#include "initial/initial_fill.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/numbering.hpp"
#include "level/refinement.hpp"
#include "level/room.hpp"
#include "level/volume/surface_level.hpp"
#include "level/volume/vacancies.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

namespace {

struct NodesByCarrier {
  GivenNodes<3> inner, on_surfaces, on_features;

  explicit NodesByCarrier(const GivenNodes<3>& given) {
    for (const GivenNode<3>& node : given)
      (node.is_inner()                    ? inner
       : node.carrier == Carrier::surface ? on_surfaces
                                          : on_features)
          .push_back(node);
  }
};

std::int64_t sum_over_ranks(const Communicator& comm, std::int64_t mine) {
  return static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(mine)));
}

}  // namespace

// These nodes become those of the level, and rest on its surfaces.
template <>
void PlacementOf<3>::rest_on_surfaces(Level<3>& level, GivenNodes<3> on_surfaces,
                                      const GivenNodes<3>& on_features, Outcome& outcome,
                                      LevelRole role) {
  const bool anew = comm_->allreduce_sum(on_surfaces.size()) == 0;
  state_.deleted +=
      sum_over_ranks(*comm_, put_surface_nodes(level, std::move(on_surfaces), on_features, anew));
  Schedule schedule;
  schedule.first_nodes = first_nodes_of(!anew, false);
  schedule.role = role;
  Simulation<3> simulation(level, schedule, state_, monitoring_);
  const Settings& settings = level.settings;
  const double done = done_by_rounds();
  if (outcome != Outcome::stopped &&
      simulation.advance(anew ? settings.steps : settings.refined_steps, {done, done}) ==
          Outcome::stopped)
    outcome = Outcome::stopped;
  if (outcome == Outcome::stopped) return;
  simulation.remove_crowded();  // nodes that coincide have no star
  state_.inserted += fill_vacancies(level);
  sweep_on_surfaces(level, settings.sweeps);
}

// The nodes of the boundary among those given, which may be from a coarser level, come to rest on
// the level's surfaces, and are given instead; if there are none, the surfaces are filled.
// If the monitor has stopped the call, or does so here, they stay as they are. Collective.
template <>
void PlacementOf<3>::settle_surfaces(Level<3>& level, GivenNodes<3>& given, Outcome& outcome,
                                     LevelRole role) {
  scatter_to_owners(level, given);
  reserve_ids(level, given);
  NodesByCarrier nodes(given);
  const Settings inside = level.settings;
  {
    const Showing<3> showing(results_, &level);
    level.change_settings(surface_settings(inside));
    rest_on_surfaces(level, std::move(nodes.on_surfaces), nodes.on_features, outcome, role);
    fix_surface_nodes(level);
    level.change_settings(inside);
  }
  given = surface_nodes(level);
  agreed(*comm_, [&] { put_on_level_sets(level.ground, given); });
  scatter_to_owners(level, given);  // some have moved on since the last exchange
  given.insert(given.end(), nodes.inner.begin(), nodes.inner.end());
}

// Coarser levels from which the nodes on surfaces come: where these are flat and d is even there,
// one lattice fills each; else a few.
template <>
int PlacementOf<3>::surface_levels_that_pay(const Level<3>& finest) const {
  constexpr double kMinNodes = 100;  // on the surfaces of the coarsest
  const Surface& surface = finest.ground.surface();
  bool flat = true;
  for (std::int32_t p = 0; p < surface.features().patches; ++p) flat = flat && surface.is_flat(p);
  const SpacingVariation d = spacing_variation(finest);
  if (flat && d.max <= kPatchVariation * d.min) return 0;
  const double nodes = 1.15 * domain_->area() / (d.max * d.max);
  int levels = 0;
  while (levels < finest.settings.levels && nodes >= kMinNodes * std::ldexp(1.0, 2 * levels + 2))
    ++levels;
  return levels;
}

// These of the surfaces, or a fill of them if there are none, become the nodes of a level of
// surfaces alone, which the time loop moves. Returns how many of this rank's are too dense for d.
// Collective.
template <>
std::int64_t PlacementOf<3>::put_on_surfaces(Level<3>& level, GivenNodes<3> given) {
  scatter_to_owners(level, given);
  reserve_ids(level, given);
  NodesByCarrier nodes(given);
  const bool anew = comm_->allreduce_sum(nodes.on_surfaces.size()) == 0;
  return put_surface_nodes(level, std::move(nodes.on_surfaces), nodes.on_features, anew);
}

namespace {

// Nodes given anywhere go to the nearest point of the surfaces, unless that is farther than d or
// on top of a feature edge. Returns how many go nowhere.
std::int64_t bring_to_surfaces(const Level<3>& level, GivenNodes<3>& given) {
  const Ground<3>& ground = level.ground;
  std::vector<Point<3>> places;
  for (GivenNode<3>& node : given) {
    const NearestPoint<3> nearest = ground.domain().index().nearest(node.position, kFarAway);
    node.carrier = Carrier::surface;
    node.boundary_node = nearest.facet;
    node.tag = ground.boundary().facets[static_cast<std::size_t>(nearest.facet)].tag;
    places.push_back(nearest.x);
  }
  std::vector<double> d(places.size());
  ground.evaluator()(std::ssize(places), places.data(), d.data());
  GivenNodes<3> brought;
  for (std::size_t k = 0; k < given.size(); ++k) {
    GivenNode<3> node = given[k];
    const SurfacePoint at{node.boundary_node, places[k]};
    const double room = kBoundaryClearance * d[k];
    if (ground.surface().patch(at.facet) < 0 || distance<3>(node.position, places[k]) > d[k] ||
        ground.surface().feature_clearance(at, room) < room)
      continue;
    node.position = places[k];
    node.d = d[k];
    brought.push_back(node);
  }
  const auto left_out = static_cast<std::int64_t>(given.size() - brought.size());
  given = std::move(brought);
  return left_out;
}

}  // namespace

// The nodes that surfaces alone begin with: those there are, those given, or what coarser levels
// lead to. Collective.
template <>
TakenNodes PlacementOf<3>::begin_on_surfaces(Level<3>& finest,
                                             const std::shared_ptr<const Spacing<3>>& spacing,
                                             const Settings& settings, Outcome& outcome) {
  TakenNodes taken;
  GivenNodes<3> nodes;
  if (level_) {
    nodes = refined(*level_, *spacing);
    finest.next_id = level_->next_id;
    taken.numbered = sum_over_ranks(*comm_, std::ranges::count(nodes, -1, &GivenNode<3>::id));
  } else if (start_from_given_) {
    nodes = given_;
    agreed(*comm_, [&] { taken.left_out = bring_to_surfaces(finest, nodes); });
    taken.left_out = sum_over_ranks(*comm_, taken.left_out);
  } else {
    state_.filled_level = state_.coarser_levels = surface_levels_that_pay(finest);
    if (state_.coarser_levels > 0)
      nodes = nodes_from_coarser_levels(finest, spacing, settings, outcome);
  }
  taken.thinned = sum_over_ranks(*comm_, put_on_surfaces(finest, std::move(nodes)));
  return taken;
}

}  // namespace pnpbs
