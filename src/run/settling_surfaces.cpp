// SPDX-License-Identifier: BSD-3-Clause
#include "run/settling_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/clearance.hpp"
#include "initial/initial_fill.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/numbering.hpp"
#include "level/room.hpp"
#include "level/volume/opposite_nodes.hpp"
#include "level/volume/surface_level.hpp"
#include "level/volume/vacancies.hpp"
#include "method/constants.hpp"
#include "run/simulation.hpp"

namespace pnpbs {

namespace {

struct NodesByCarrier {
  IncomingNodes<3> inner, on_surfaces, on_features;

  explicit NodesByCarrier(const IncomingNodes<3>& incoming) {
    for (const IncomingNode<3>& node : incoming)
      (node.is_inner()                    ? inner
       : node.carrier == Carrier::surface ? on_surfaces
                                          : on_features)
          .push_back(node);
  }
};

// Returns the settings for the time in which only the surfaces have nodes. The partition of a body
// is not changed then: it balances the nodes that the body will have. A partition that balances the
// surface nodes would have jagged borders inside.
Settings settings_on_surfaces(const Level<3>& level) {
  Settings settings = surface_settings(level.settings);
  if (level.geometry.kind() != GeometryKind::surface)
    settings.rebalance_above = std::numeric_limits<double>::infinity();
  return settings;
}

std::int64_t sum_over_ranks(const Communicator& comm, std::int64_t mine) {
  return static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(mine)));
}

// Finds the facets that nodes on surfaces lie on. The level that the nodes come from may number its
// facets otherwise, because it may have another number of copies of a periodic cell.
void find_facets_again(const Level<3>& level, IncomingNodes<3>& incoming) {
  if (!level.nodes.cell.any()) return;
  const SurfaceIndex& index = level.geometry.domain().index();
  for_each("pnpbs::find_facets_again", std::ssize(incoming), [&](std::int64_t k) {
    IncomingNode<3>& node = incoming[static_cast<std::size_t>(k)];
    if (node.carrier == Carrier::surface)
      node.boundary_node = index.nearest(node.position, kFarAway).facet;
  });
}

// Puts these nodes on the level and lets them come to rest on its surfaces.
void rest_on_surfaces(Level<3>& level, IncomingNodes<3> on_surfaces,
                      const IncomingNodes<3>& on_features, Outcome& outcome, LevelRole role,
                      const LevelContext<3>& context) {
  const bool anew = level.comm->allreduce_sum(on_surfaces.size()) == 0;
  context.run.deleted += sum_over_ranks(
      *level.comm, put_surface_nodes(level, std::move(on_surfaces), on_features, anew));
  Schedule schedule;
  schedule.first_nodes = first_nodes_of(!anew, false);
  schedule.role = role;
  Simulation<3> simulation(level, schedule, context.run, context.monitoring);
  const Settings& settings = level.settings;
  if (outcome != Outcome::stopped &&
      simulation.advance(anew ? settings.steps : settings.refined_steps,
                         {context.done, context.done}) == Outcome::stopped)
    outcome = Outcome::stopped;
  if (outcome == Outcome::stopped) return;
  simulation.remove_crowded();  // coincident nodes have no star
  context.run.inserted += fill_vacancies(level);
  sweep_on_surfaces(level, settings.sweeps);
  if (role != LevelRole::surfaces || level.geometry.kind() != GeometryKind::body) return;
  const PopulationCounts opposite = place_opposite_nodes(level);
  context.run.inserted += opposite.inserted;
  context.run.deleted += opposite.deleted;
}

}  // namespace

void settle_surfaces(Level<3>& level, IncomingNodes<3>& incoming, Outcome& outcome, LevelRole role,
                     const LevelContext<3>& context) {
  collective_try(*level.comm, [&] { find_facets_again(level, incoming); });
  scatter_to_owners(level, incoming);
  reserve_ids(level, incoming);
  NodesByCarrier nodes(incoming);
  const Settings inside = level.settings;
  {
    const ScopedLevel<3> showing(context.results, &level);
    level.change_settings(settings_on_surfaces(level));
    rest_on_surfaces(level, std::move(nodes.on_surfaces), nodes.on_features, outcome, role,
                     context);
    fix_surface_nodes(level);
    level.change_settings(inside);
  }
  incoming = surface_nodes(level);
  collective_try(*level.comm, [&] { put_on_level_sets(level.geometry, incoming); });
  scatter_to_owners(level, incoming);  // some have moved since the last exchange
  incoming.insert(incoming.end(), nodes.inner.begin(), nodes.inner.end());
}

int surface_levels_that_pay(const Level<3>& finest) {
  const Surface& surface = finest.geometry.surface();
  bool flat = true;
  for (std::int32_t p = 0; p < surface.features().patches; ++p) flat = flat && surface.is_flat(p);
  const SpacingVariation d = spacing_variation(finest);
  if (flat && d.max <= method::kPatchVariation * d.min) return 0;
  const double nodes = 1.15 * finest.geometry.domain().area() / (d.max * d.max);
  int levels = 0;
  while (levels < finest.settings.levels &&
         nodes >= method::kMinNodesOfCoarsestSurface * std::ldexp(1.0, 2 * levels + 2))
    ++levels;
  return levels;
}

std::int64_t put_on_surfaces(Level<3>& level, IncomingNodes<3> incoming) {
  scatter_to_owners(level, incoming);
  reserve_ids(level, incoming);
  NodesByCarrier nodes(incoming);
  const bool anew = level.comm->allreduce_sum(nodes.on_surfaces.size()) == 0;
  return put_surface_nodes(level, std::move(nodes.on_surfaces), nodes.on_features, anew);
}

std::int64_t bring_to_surfaces(const Level<3>& level, IncomingNodes<3>& incoming) {
  const LevelGeometry<3>& geometry = level.geometry;
  std::vector<Point<3>> places;
  for (IncomingNode<3>& node : incoming) {
    const NearestPoint<3> nearest = geometry.domain().index().nearest(node.position, kFarAway);
    node.carrier = Carrier::surface;
    node.boundary_node = nearest.facet;
    node.tag = geometry.boundary().facets[static_cast<std::size_t>(nearest.facet)].tag;
    places.push_back(nearest.x);
  }
  std::vector<double> d(places.size());
  geometry.evaluator()(std::ssize(places), places.data(), d.data());
  IncomingNodes<3> brought;
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    IncomingNode<3> node = incoming[k];
    const SurfacePoint at{node.boundary_node, places[k]};
    const double room = method::kBoundaryClearance * d[k];
    if (geometry.surface().patch(at.facet) < 0 || distance<3>(node.position, places[k]) > d[k] ||
        geometry.surface().feature_clearance(at, room) < room)
      continue;
    node.position = places[k];
    node.d = d[k];
    brought.push_back(node);
  }
  const auto left_out = static_cast<std::int64_t>(incoming.size() - brought.size());
  incoming = std::move(brought);
  return left_out;
}

}  // namespace pnpbs
