// SPDX-License-Identifier: BSD-3-Clause
#include "level/ghost_lists.hpp"

#include <algorithm>
#include <iterator>

#include "neighbors/rings.hpp"

namespace pnpbs {

ListsOf lists_of_stars(const Level<2>&) { return ListsOf::all_nodes; }
ListsOf lists_of_stars(const Level<3>& level) {
  return level.geometry.kind() == GeometryKind::surface ? ListsOf::all_nodes : ListsOf::owned_nodes;
}

namespace {

template <int Dim>
void add_lists_of(Level<Dim>& level, const std::vector<std::int32_t>& nodes) {
  const PhaseTimer timer(level.timers, Phase::lists);
  std::vector<std::int32_t> more;
  std::ranges::copy_if(nodes, std::back_inserter(more),
                       [&](std::int32_t i) { return !level.lists().has(i); });
  if (more.empty()) return;
  level.neighbourhood.add_lists(level.nodes, level.geometry, *level.tree, more);
  level.timers.add(Phase::lists, {std::ssize(more), 0});
}

}  // namespace

template <int Dim>
void add_lists_around(Level<Dim>& level, const std::vector<std::int32_t>& nodes, int rings) {
  if (level.neighbourhood.listed() == ListsOf::all_nodes) return;
  std::vector<char> reached(static_cast<std::size_t>(level.nodes.count), 0);
  for (const std::int32_t i : nodes) reached[static_cast<std::size_t>(i)] = 1;
  std::vector<std::int32_t> front = nodes;
  add_lists_of(level, front);
  for (int ring = 0; ring < rings; ++ring) {
    front = next_ring(level.lists(), front, reached);
    add_lists_of(level, front);
  }
}

template void add_lists_around(Level<2>&, const std::vector<std::int32_t>&, int);
template void add_lists_around(Level<3>&, const std::vector<std::int32_t>&, int);

}  // namespace pnpbs
