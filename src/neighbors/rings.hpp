// SPDX-License-Identifier: BSD-3-Clause
// The rings of neighbours around a node: of its adjacency list or of its star. Contests look
// through them: whoever is not outdone by a node within some rings may act.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pnpbs {

// Calls visit(j, ring) for each node within so many rings around node i, but itself, ring by ring
// from 1 on, until it returns false. Returns whether it never did.
template <class Graph, class Visit>
bool for_rings(const Graph& graph, std::int64_t i, int rings, const Visit& visit) {
  std::vector<std::int64_t> reached{i};
  std::size_t begin = 0;
  bool all = true;
  for (int ring = 1; ring <= rings && all; ++ring) {
    const std::size_t end = reached.size();
    for (std::size_t k = begin; k < end && all; ++k)
      graph.for_neighbours(reached[k], [&](std::int64_t j) {
        if (!all || std::find(reached.begin(), reached.end(), j) != reached.end()) return;
        reached.push_back(j);
        all = visit(j, ring);
      });
    begin = end;
  }
  return all;
}

// The neighbours of these nodes that are not reached yet, which they are then.
template <class Graph, class Index>
std::vector<Index> next_ring(const Graph& graph, const std::vector<Index>& front,
                             std::vector<char>& reached) {
  std::vector<Index> next;
  for (const Index i : front)
    graph.for_neighbours(i, [&](std::int64_t j) {
      char& known = reached[static_cast<std::size_t>(j)];
      if (!known) next.push_back(static_cast<Index>(j));
      known = 1;
    });
  return next;
}

}  // namespace pnpbs
