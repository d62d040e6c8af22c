// SPDX-License-Identifier: BSD-3-Clause
// Nodes that have no room: between boundary edges, or on top of another node.
#include <algorithm>

#include "domain/clearance.hpp"
#include "dynamics/bubble_force.hpp"
#include "level/level.hpp"

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

}  // namespace

// The nodes with smaller ids that node i nearly coincides with: those push it no more.
template <class Visit>
void Level::for_coinciding(std::int64_t i, const Visit& visit) const {
  const Point<2> x = nodes_.position(i);
  lists_.for_neighbours(i, [&](std::int64_t j) {
    if (nodes_.moves(j) && nodes_.id(j) < nodes_.id(i) &&
        distance<2>(x, nodes_.position(j)) < kNearlyCoincide * nodes_.d(i))
      visit(j);
  });
}

// As the edges were found where the nodes are.
bool Level::between_edges(std::int64_t i) const {
  return near_edges_.edge_within(i, kLeastClearance * nodes_.d(i));
}

// A flag for each node that is between boundary edges, or on top of another node: of two that
// nearly coincide it is the one with the larger id. Lists must be fresh, and made where the nodes
// are.
View<char> Level::nodes_without_room() const {
  constexpr double kALittleMore = 1.001;  // so that rounding decides nothing here
  const View<char> no_room = make_view<char>("pnpbs::Level::no_room", nodes_.count);
  for_each("pnpbs::Level::no_room", lists_.block_count(), [&](std::int64_t b) {
    const bool look = any_neighbour_within(nodes_, lists_, kALittleMore * kNearlyCoincide, b);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes_.count); ++i) {
      no_room(i) = 0;
      if (!nodes_.moves(i)) continue;
      no_room(i) = between_edges(i);
      if (look) for_coinciding(i, [&](std::int64_t) { no_room(i) = 1; });
    }
  });
  return no_room;
}

// After the last population event nodes may still be pressed into a corner until they coincide.
// Here nothing is born, so there is no contest: of many in one place all go at once but the first.
// One that only coincides with nodes that may go themselves waits for the next round.
PopulationCounts Level::remove_crowded() {
  PopulationCounts counts;
  while (true) {
    prepare_finish();
    std::vector<std::int32_t> crowded;
    agreed(*comm_, [&] { crowded = crowded_nodes(); });
    const auto own = std::count_if(crowded.begin(), crowded.end(),
                                   [this](std::int32_t i) { return nodes_.owned(i) != 0; });
    if (comm_->allreduce_sum(static_cast<std::uint64_t>(own)) == 0) return counts;
    counts.deleted += own;
    ++version_;
    delete_nodes(crowded);
  }
}

std::vector<std::int32_t> Level::crowded_nodes() const {
  const PhaseTimer timer(timers_, Phase::population);
  const View<char> no_room = nodes_without_room();
  std::vector<std::int32_t> crowded;
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    if (!no_room(i)) continue;
    bool goes = between_edges(i);
    for_coinciding(i, [&](std::int64_t j) { goes = goes || !no_room(j); });
    if (goes) crowded.push_back(static_cast<std::int32_t>(i));
  }
  return crowded;
}

}  // namespace pnpbs
