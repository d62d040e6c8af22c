// SPDX-License-Identifier: BSD-3-Clause
#include "level/room.hpp"

#include <algorithm>

#include "dynamics/bubble_force.hpp"
#include "geometry/clearance.hpp"
#include "level/finish.hpp"
#include "level/ghost_lists.hpp"
#include "level/plane/closed_sphere.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Returns whether any node of block b has a listed neighbour within `reach` times its d.
template <int Dim>
bool any_neighbour_within(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, double reach,
                          std::int64_t b) {
  const Positions<Dim> x = positions_of<Dim>(nodes.x);
  std::int64_t self[kLanes];
  block_nodes(b, nodes.count, self);
  double own[Dim][kLanes], square_reach[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int k = 0; k < Dim; ++k) own[k][lane] = x[k][self[lane]];
    square_reach[lane] = reach * reach * nodes.d(self[lane]) * nodes.d(self[lane]);
  }
  const ListBlock list = lists.block(b);
  const std::int32_t* entries = list.entries;
  double within = -1;
  for (std::int32_t n = 0; n < list.length; ++n, entries += kLanes) {
#pragma omp simd reduction(max : within)
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t j = entries[lane];
      double square = 0;
      for (int k = 0; k < Dim; ++k) square += (own[k][lane] - x[k][j]) * (own[k][lane] - x[k][j]);
      within = std::max(within, square_reach[lane] - square);
    }
  }
  return within >= 0;
}

// Calls visit(j) for the nodes j with smaller ids that node i nearly coincides with. The repulsion
// no longer separates them.
template <int Dim, class Visit>
void for_coinciding(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i,
                    const Visit& visit) {
  const Point<Dim> x = nodes.position(i);
  lists.for_neighbours(i, [&](std::int64_t j) {
    if (nodes.moves(j) && nodes.id(j) < nodes.id(i) &&
        distance<Dim>(x, nodes.position(j)) < method::kNearlyCoincide * nodes.d(i))
      visit(j);
  });
}

// Returns whether the boundary is closer to node i than the minimum clearance, for the positions at
// which the boundary was found.
template <int Dim>
bool pressed_to_boundary(const Level<Dim>& level, std::int64_t i) {
  return level.neighbourhood.near_boundary().within(i, method::kMinClearance * level.nodes.d(i));
}

// Returns the index that tests for the inside and for near facets.
const FacetIndex<2>& facets_of(const Level<2>& level) { return level.map(); }
const SurfaceIndex& facets_of(const Level<3>& level) { return level.geometry.domain().index(); }

}  // namespace

template <int Dim>
bool has_clearance(const Level<Dim>& level, const std::type_identity_t<Point<Dim>>& x, double d) {
  // Positions on surfaces are valid by construction.
  if (level.nodes.moving == Carrier::surface) return true;
  if (is_closed_at(level, x)) return false;
  const Box<Dim>& box = level.geometry.bounds();
  for (int k = 0; k < Dim; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  const double clearance = (Dim == 2 ? method::kBoundaryClearance : method::kNewNodeClearance) * d;
  const auto& facets = facets_of(level);
  return facets.inside(x) && facets.clearance(x, clearance) >= clearance;
}

template <int Dim>
View<char> nodes_without_room(const Level<Dim>& level) {
  const Nodes<Dim>& nodes = level.nodes;
  const AdjacencyList<Dim>& lists = level.lists();
  constexpr double kALittleMore = 1.001;  // keeps rounding from affecting the result
  const View<char> no_room = make_view<char>("pnpbs::no_room", nodes.count);
  for_each("pnpbs::no_room", lists.block_count(), [&](std::int64_t b) {
    const bool look = any_neighbour_within(nodes, lists, kALittleMore * method::kNearlyCoincide, b);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes.count); ++i) {
      no_room(i) = 0;
      if (!nodes.moves(i) || !lists.has(i)) continue;
      no_room(i) = pressed_to_boundary(level, i);
      if (look) for_coinciding(nodes, lists, i, [&](std::int64_t) { no_room(i) = 1; });
    }
  });
  return no_room;
}

namespace {

// Hops of the lists that a decision about coincident nodes reaches: a node is kept for now if the
// one it coincides with itself coincides with another.
constexpr int kCoincidingHops = 2;

template <int Dim>
std::vector<std::int32_t> owned_without_room(const Nodes<Dim>& nodes, const View<char>& no_room) {
  std::vector<std::int32_t> found;
  for (std::int32_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i) && no_room(i)) found.push_back(i);
  return found;
}

template <int Dim>
std::vector<std::int32_t> crowded_nodes(Level<Dim>& level) {
  const Nodes<Dim>& nodes = level.nodes;
  const std::vector<std::int32_t> waiting =
      owned_without_room(nodes, nodes_without_room<Dim>(level));
  if (waiting.empty()) return {};
  add_lists_around(level, waiting, kCoincidingHops - 1);
  const View<char> no_room = nodes_without_room<Dim>(level);
  std::vector<std::int32_t> crowded;
  for (const std::int32_t i : waiting) {
    bool goes = pressed_to_boundary(level, i);
    for_coinciding(nodes, level.lists(), i, [&](std::int64_t j) { goes = goes || !no_room(j); });
    if (goes) crowded.push_back(i);
  }
  return crowded;
}

}  // namespace

// After the last population event nodes may still be pressed into a corner until they coincide.
// Nothing is inserted here, so no contest is needed: of several nodes at one point all but the
// first are deleted at once. A node that only coincides with nodes which may be deleted is decided
// in the next round.
template <int Dim>
PopulationCounts remove_crowded(Level<Dim>& level) {
  const PhaseTimer timer(level.timers, Phase::population);
  PopulationCounts counts;
  while (true) {
    require_finish_lists(level);
    std::vector<std::int32_t> crowded;
    collective_try(*level.comm, [&] {
      crowded = crowded_nodes(level);
      count_uses_by_event(level, kCoincidingHops);
    });
    if (level.comm->allreduce_sum(crowded.size()) == 0) return counts;
    counts.deleted += std::ssize(crowded);
    delete_nodes(level, crowded);
  }
}

template bool has_clearance(const Level<2>&, const Point<2>&, double);
template bool has_clearance(const Level<3>&, const Point<3>&, double);
template View<char> nodes_without_room(const Level<2>&);
template View<char> nodes_without_room(const Level<3>&);
template PopulationCounts remove_crowded(Level<2>&);
template PopulationCounts remove_crowded(Level<3>&);

}  // namespace pnpbs
