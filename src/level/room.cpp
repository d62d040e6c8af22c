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

// Has any node of block b a listed neighbour within so many of its d?
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

// The nodes with smaller ids that node i nearly coincides with: those push it no more.
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

// As the boundary was found where the nodes are.
template <int Dim>
bool pressed_to_boundary(const Level<Dim>& level, std::int64_t i) {
  return level.neighbourhood.near_boundary().within(i, method::kMinClearance * level.nodes.d(i));
}

// What tells the inside and what is near.
const FacetIndex<2>& facets_of(const Level<2>& level) { return level.map(); }
const SurfaceIndex& facets_of(const Level<3>& level) { return level.geometry.domain().index(); }

}  // namespace

template <int Dim>
bool has_clearance(const Level<Dim>& level, const std::type_identity_t<Point<Dim>>& x, double d) {
  if (level.nodes.moving == Carrier::surface) return true;  // it was walked to
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
  constexpr double kALittleMore = 1.001;  // so that rounding decides nothing here
  const View<char> no_room = make_view<char>("pnpbs::no_room", nodes.count);
  for_each("pnpbs::no_room", lists.block_count(), [&](std::int64_t b) {
    const bool look = any_neighbour_within(nodes, lists, kALittleMore * method::kNearlyCoincide, b);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes.count); ++i) {
      no_room(i) = 0;
      if (!nodes.moves(i)) continue;
      no_room(i) = pressed_to_boundary(level, i);
      if (look) for_coinciding(nodes, lists, i, [&](std::int64_t) { no_room(i) = 1; });
    }
  });
  return no_room;
}

namespace {

// A node waits if one that it coincides with does so with another.
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
  const PhaseTimer timer(level.timers, Phase::population);
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
// Here nothing is born, so there is no contest: of many in one place all go at once but the first.
// One that only coincides with nodes that may go themselves waits for the next round.
template <int Dim>
PopulationCounts remove_crowded(Level<Dim>& level) {
  PopulationCounts counts;
  while (true) {
    prepare_finish(level);
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
