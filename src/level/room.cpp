// SPDX-License-Identifier: BSD-3-Clause
#include "level/room.hpp"

#include <algorithm>

#include "domain/clearance.hpp"
#include "dynamics/bubble_force.hpp"
#include "level/finish.hpp"

namespace pnpbs {

namespace {

constexpr double kNearlyCoincide = 0.2;  // in units of d

// Has any node of block b a listed neighbour within so many of its d?
bool any_neighbour_within(const Nodes<2>& nodes, const AdjacencyList<2>& lists, double reach,
                          std::int64_t b) {
  const Positions<2> x = positions_of<2>(nodes.x);
  std::int64_t self[kLanes];
  block_nodes(b, nodes.count, self);
  double own[2][kLanes], square_reach[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int k = 0; k < 2; ++k) own[k][lane] = x[k][self[lane]];
    square_reach[lane] = reach * reach * nodes.d(self[lane]) * nodes.d(self[lane]);
  }
  const ListBlock list = lists.block(b);
  const std::int32_t* entries = list.entries;
  double within = -1;
  for (std::int32_t n = 0; n < list.length; ++n, entries += kLanes) {
#pragma omp simd reduction(max : within)
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t j = entries[lane];
      const double dx = own[0][lane] - x[0][j], dy = own[1][lane] - x[1][j];
      within = std::max(within, square_reach[lane] - (dx * dx + dy * dy));
    }
  }
  return within >= 0;
}

// The nodes with smaller ids that node i nearly coincides with: those push it no more.
template <class Visit>
void for_coinciding(const Nodes<2>& nodes, const AdjacencyList<2>& lists, std::int64_t i,
                    const Visit& visit) {
  const Point<2> x = nodes.position(i);
  lists.for_neighbours(i, [&](std::int64_t j) {
    if (nodes.moves(j) && nodes.id(j) < nodes.id(i) &&
        distance<2>(x, nodes.position(j)) < kNearlyCoincide * nodes.d(i))
      visit(j);
  });
}

// As the edges were found where the nodes are.
bool between_edges(const Level& level, std::int64_t i) {
  return level.neighbourhood.near_edges().edge_within(i, kMinClearance * level.nodes.d(i));
}

}  // namespace

bool has_clearance(const Level& level, const Point<2>& x, double d) {
  const Box<2>& box = level.ground.domain().bounds();
  for (int k = 0; k < 2; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  return level.map().inside(x) &&
         level.map().clearance(x, kBoundaryClearance * d) >= kBoundaryClearance * d;
}

View<char> nodes_without_room(const Level& level) {
  const Nodes<2>& nodes = level.nodes;
  const AdjacencyList<2>& lists = level.lists();
  constexpr double kALittleMore = 1.001;  // so that rounding decides nothing here
  const View<char> no_room = make_view<char>("pnpbs::no_room", nodes.count);
  for_each("pnpbs::no_room", lists.block_count(), [&](std::int64_t b) {
    const bool look = any_neighbour_within(nodes, lists, kALittleMore * kNearlyCoincide, b);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes.count); ++i) {
      no_room(i) = 0;
      if (!nodes.moves(i)) continue;
      no_room(i) = between_edges(level, i);
      if (look) for_coinciding(nodes, lists, i, [&](std::int64_t) { no_room(i) = 1; });
    }
  });
  return no_room;
}

namespace {

std::vector<std::int32_t> crowded_nodes(const Level& level) {
  const Nodes<2>& nodes = level.nodes;
  const PhaseTimer timer(level.timers, Phase::population);
  const View<char> no_room = nodes_without_room(level);
  std::vector<std::int32_t> crowded;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!no_room(i)) continue;
    bool goes = between_edges(level, i);
    for_coinciding(nodes, level.lists(), i, [&](std::int64_t j) { goes = goes || !no_room(j); });
    if (goes) crowded.push_back(static_cast<std::int32_t>(i));
  }
  return crowded;
}

}  // namespace

// After the last population event nodes may still be pressed into a corner until they coincide.
// Here nothing is born, so there is no contest: of many in one place all go at once but the first.
// One that only coincides with nodes that may go themselves waits for the next round.
PopulationCounts remove_crowded(Level& level) {
  PopulationCounts counts;
  while (true) {
    prepare_finish(level);
    std::vector<std::int32_t> crowded;
    agreed(*level.comm, [&] { crowded = crowded_nodes(level); });
    const auto own = std::count_if(crowded.begin(), crowded.end(),
                                   [&](std::int32_t i) { return level.nodes.owned(i) != 0; });
    if (level.comm->allreduce_sum(static_cast<std::uint64_t>(own)) == 0) return counts;
    counts.deleted += own;
    delete_nodes(level, crowded);
  }
}

}  // namespace pnpbs
