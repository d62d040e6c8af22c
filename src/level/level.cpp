// SPDX-License-Identifier: BSD-3-Clause
#include "level/level.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "level/reach.hpp"

namespace pnpbs {

namespace {

std::int64_t next_number() {
  static std::atomic<std::int64_t> next = 0;
  return next++;
}

}  // namespace

template <int Dim>
Level<Dim>::Level(std::shared_ptr<const Communicator> communicator,
                  std::shared_ptr<const Domain<Dim>> domain,
                  std::shared_ptr<const Spacing<Dim>> spacing, const Settings& with, Timers& into)
    : LevelState<Dim>{.tree = nullptr, .nodes = {}, .ghosts = {}, .settings = with, .inexact = {}},
      number(next_number()),
      comm(std::move(communicator)),
      timers(into),
      geometry(std::move(domain), std::move(spacing), with.node_limit()) {
  nodes.cell = geometry.cell();
  neighbourhood.reset_boundary(geometry);
}

template <int Dim>
void Level<Dim>::grow_tree(const Level<Dim>* like) {
  const PhaseTimer timer(timers, distributed() ? Phase::partition : Phase::tree);
  tree = LevelTree<Dim>::grow(*comm, geometry, settings, like ? like->tree.get() : nullptr);
  neighbourhood.adopt(*tree, NearBoundary<Dim>::near_leaves(*tree, edge_radius(settings)));
}

template <int Dim>
void Level<Dim>::adopt_partition(Distribution<Dim> next) {
  std::shared_ptr<LevelTree<Dim>> grown =
      LevelTree<Dim>::grow(*comm, geometry, settings, std::move(next));
  typename NearBoundary<Dim>::NearLeaves near;
  collective_try(*comm,
                 [&] { near = NearBoundary<Dim>::near_leaves(*grown, edge_radius(settings)); });
  neighbourhood.adopt(*grown, std::move(near));
  ghosts = Ghosts<Dim>();
  tree = std::move(grown);
}

template <int Dim>
LevelCopy<Dim> Level<Dim>::copy() const {
  LevelCopy<Dim> copied{*this, neighbourhood.figures(nodes)};
  copied.state.nodes = nodes.copy();
  return copied;
}

template <int Dim>
void Level<Dim>::restore(LevelCopy<Dim>&& earlier) noexcept {
  LevelState<Dim>& state = earlier.state;
  const std::int64_t before = version();
  state.nodes.renew_stamps(nodes);
  state.ghosts.invalidate();
  static_cast<LevelState<Dim>&>(*this) = std::move(state);
  neighbourhood.forget(*tree, nodes, earlier.figures);
  forget_stars();
  settings_version += before - version() + 1;
}

template <int Dim>
void Level<Dim>::forget_derived() noexcept {
  ghosts.invalidate();
  tree->forget_hops();
  neighbourhood.forget(*tree, nodes, neighbourhood.figures(nodes));
  forget_stars();
  ++settings_version;
}

template <int Dim>
void Level<Dim>::forget_stars() noexcept {
  stars = {};
  stars_before.forget();
  stars_digest = 0;
  changed_labels = {};
  finish_stars = -1;
}

template <int Dim>
void Level<Dim>::change_settings(const Settings& next) {
  const Settings before = settings;
  settings = next;
  ++settings_version;
  ghosts.invalidate();
  if (widest_radius(settings) != widest_radius(before) ||
      settings.list_radius != before.list_radius)
    tree->forget_hops();  // the length of a hop has changed
  // Nodes count as far from the boundary according to the number of steps since their reference
  // positions.
  if (meeting_radius(settings) != meeting_radius(before)) nodes.set_reference_positions();
  if (edge_radius(settings) != neighbourhood.near_boundary().radius())
    neighbourhood.adopt(*tree, NearBoundary<Dim>::near_leaves(*tree, edge_radius(settings)));
}

template <int Dim>
std::int64_t Level<Dim>::owned_count() const {
  return pnpbs::owned_count(nodes);
}

std::int64_t boundary_nodes(const Level<2>& level) {
  const std::vector<BoundaryNode<2>>& nodes = level.geometry.boundary().nodes;
  std::int64_t count = 0;
  for (std::int64_t b = 0; b < std::ssize(nodes); ++b)
    count += level.geometry.boundary_node_in_cell(b) &&
             !level.geometry.domain().is_in_patch(nodes[static_cast<std::size_t>(b)].position);
  return count;
}

std::int64_t boundary_nodes(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  const std::uint64_t own = sum_of("pnpbs::boundary_nodes", nodes.count, [&](std::int64_t i) {
    return nodes.owned(i) != 0 && nodes.carrier(i) != Carrier::free;
  });
  return static_cast<std::int64_t>(level.comm->allreduce_sum(own));
}

template struct Level<2>;
template struct Level<3>;

}  // namespace pnpbs
