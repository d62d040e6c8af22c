// SPDX-License-Identifier: BSD-3-Clause
#include "level/imported_nodes.hpp"

#include <map>

#include "level/exchange.hpp"
#include "level/numbering.hpp"
#include "level/plane/closed_sphere.hpp"
#include "level/room.hpp"
#include "level/thinning.hpp"

namespace pnpbs {

// Boundary nodes whose position is unchanged keep their ids.
BoundaryNodes<2> boundary_nodes(const LevelGeometry<2>& geometry,
                                const IncomingNodes<2>& incoming) {
  const Boundary& boundary = geometry.boundary();
  std::vector<std::int64_t> ids(boundary.nodes.size(), -1);
  std::map<Point<2>, std::int64_t> id_at;
  for (const IncomingNode<2>& node : incoming)
    if (!node.inner && node.id >= 0) id_at[node.position] = node.id;
  for (std::size_t b = 0; b < boundary.nodes.size() && !id_at.empty(); ++b) {
    const auto found = id_at.find(boundary.nodes[b].position);
    if (found != id_at.end()) ids[b] = found->second;
  }
  return BoundaryNodes<2>(boundary, std::move(ids));
}

// In space the boundary nodes are among the incoming ones.
BoundaryNodes<3> boundary_nodes(const LevelGeometry<3>&, const IncomingNodes<3>& incoming) {
  IncomingNodes<3> laid;
  for (const IncomingNode<3>& node : incoming)
    if (!node.is_inner()) laid.push_back(node);
  return BoundaryNodes<3>(std::move(laid));
}

namespace {

// Returns whether the node is in the domain and not too close to its boundary.
template <int Dim>
bool has_room(const Level<Dim>& level, const IncomingNode<Dim>& node) {
  if (is_closed_at(level, node.position)) return false;
  if (level.neighbourhood.near_boundary().leaf_is_clear(node.leaf))
    return !level.map().leaf_outside(node.leaf);
  return has_clearance(level, node.position, level.map().leaf_spacing(node.leaf));
}

template <int Dim>
void remove_without_room(const Level<Dim>& level, IncomingNodes<Dim>& incoming) {
  for_each("pnpbs::has_room", static_cast<std::int64_t>(incoming.size()), [&](std::int64_t k) {
    IncomingNode<Dim>& node = incoming[static_cast<std::size_t>(k)];
    if (node.leaf >= 0 && !has_room(level, node)) node.leaf = -1;
  });
}

}  // namespace

template <int Dim>
ImportedNodes take(Level<Dim>& level, IncomingNodes<Dim> incoming, std::int64_t next_id) {
  const PhaseTimer timer(level.timers, Phase::fill);
  const auto count_if = [&](const auto& counts) {
    return sum_of("pnpbs::take", static_cast<std::int64_t>(incoming.size()),
                  [&](std::int64_t k) { return counts(incoming[static_cast<std::size_t>(k)]); });
  };
  level.next_id = next_id;
  scatter_to_owners(level, incoming);
  BoundaryNodes<Dim> laid = boundary_nodes(level.geometry, incoming);
  const std::uint64_t all = count_if([](const IncomingNode<Dim>& node) { return node.is_inner(); });
  find_leaves(level, incoming);
  remove_without_room(level, incoming);
  const std::vector<std::int32_t> begin = sort_by_leaf(level, incoming);
  const std::uint64_t fitting = incoming.size();
  thin(level, incoming, begin);
  const std::uint64_t taken = incoming.size(),
                      numbered = count_if([](const IncomingNode<Dim>&node) { return node.id < 0; });
  number_and_store(level, std::move(incoming), std::move(laid));
  return {static_cast<std::int64_t>(level.comm->allreduce_sum(all - fitting)),
          static_cast<std::int64_t>(level.comm->allreduce_sum(fitting - taken)),
          static_cast<std::int64_t>(level.comm->allreduce_sum(numbered))};
}

template ImportedNodes take(Level<2>&, IncomingNodes<2>, std::int64_t);
template ImportedNodes take(Level<3>&, IncomingNodes<3>, std::int64_t);

}  // namespace pnpbs
