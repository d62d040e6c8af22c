// SPDX-License-Identifier: BSD-3-Clause
#include "level/level.hpp"

#include <utility>

#include "level/reach.hpp"

namespace pnpbs {

Level::Level(std::shared_ptr<const Communicator> communicator,
             std::shared_ptr<const PlaneDomain> domain, std::shared_ptr<const Spacing<2>> spacing,
             const Settings& with, Timers& into)
    : comm(std::move(communicator)),
      settings(with),
      timers(into),
      ground(std::move(domain), std::move(spacing), settings.max_nodes) {
  neighbourhood.reset_boundary(ground.boundary().nodes.size());
}

void Level::grow_tree(const Level* like) {
  const PhaseTimer timer(timers, distributed() ? Phase::partition : Phase::tree);
  tree = LevelTree::grow(*comm, ground, settings, like ? like->tree.get() : nullptr);
  neighbourhood.adopt(*tree, Neighbourhood::edges_near_leaves(*tree, edge_radius(settings)));
}

void Level::adopt_partition(Distribution<2> next) {
  std::unique_ptr<LevelTree> grown = LevelTree::grow(*comm, ground, settings, std::move(next));
  NearEdges edges;
  agreed(*comm, [&] { edges = Neighbourhood::edges_near_leaves(*grown, edge_radius(settings)); });
  neighbourhood.adopt(*grown, std::move(edges));
  ghosts = Ghosts();
  tree = std::move(grown);
}

void Level::change_settings(const Settings& next) {
  const Settings before = settings;
  settings = next;
  ++settings_version;
  ghosts.choose_anew();
  if (widest_radius(settings) != widest_radius(before) ||
      settings.list_radius != before.list_radius)
    tree->forget_hops();  // a hop has another length now
  // Nodes count as far from the boundary by the steps that were left since their reference
  // positions.
  if (meeting_radius(settings) != meeting_radius(before)) nodes.set_reference_positions();
  if (edge_radius(settings) != neighbourhood.near_edges().radius())
    neighbourhood.adopt(*tree, Neighbourhood::edges_near_leaves(*tree, edge_radius(settings)));
}

std::int64_t Level::owned_count() const {
  return static_cast<std::int64_t>(sum_of("pnpbs::Level::owned_count", nodes.count,
                                          [this](std::int64_t i) { return nodes.owned(i); }));
}

}  // namespace pnpbs
