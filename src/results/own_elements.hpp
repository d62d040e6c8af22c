// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra of a level, each once over all ranks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/found_indices.hpp"
#include "delaunay/volume/element_rule.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Calls visit(element, corners) for the elements whose node with the smallest id is the owned node
// i. The nodes of `element` are in the order of ids, so that values computed from it have the same
// bits on any number of ranks. `corners` are memory indices. Uses the present stars.
template <class Visit>
void for_own_elements_at(const Level<3>& level, std::int64_t i, const Visit& visit) {
  const Nodes<3>& nodes = level.nodes;
  if (!nodes.owned(i)) return;
  level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    if (std::ranges::any_of(others, [&](auto j) { return nodes.id(j) < nodes.id(i); })) return;
    const std::array<std::int64_t, 4> corners{i, others[0], others[1], others[2]};
    visit(ordered_by_id(tetrahedron_of(nodes, corners)), corners);
  });
}

// Calls visit(element, corners) for the elements of all owned nodes for which holds(element,
// corners) returns true. All threads search, and one thread calls visit.
template <class Holds, class Visit>
void for_own_elements_where(const char* label, const Level<3>& level, const Holds& holds,
                            const Visit& visit) {
  const auto any_at = [&](std::int64_t i) {
    bool any = false;
    for_own_elements_at(level, i, [&](const auto&... element) { any = any || holds(element...); });
    return any;
  };
  for (const std::int64_t i : indices_where(label, level.nodes.count, any_at))
    for_own_elements_at(level, i, [&](const auto&... element) {
      if (holds(element...)) visit(element...);
    });
}

}  // namespace pnpbs
