// SPDX-License-Identifier: BSD-3-Clause
// Rings of neighbours around a node, in its adjacency list or its star. Contests use them: a
// candidate acts only if no better one exists within a number of rings.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pnpbs {

// Calls visit(j, ring) for each node within `rings` rings around node i, except i itself, ring by
// ring from 1 on. Ends at the first call that returns false. Returns true if no call did.
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

// Returns the neighbours of the nodes in `front` that are not marked in `reached`, and marks them.
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
