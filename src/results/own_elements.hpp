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

// Calls visit(element, corners) for the elements whose node with the least id is this owned one:
// the nodes at the corners in the order of ids, so that the bits of what is computed of it do not
// depend on ranks, and the corners' memory indices. From the stars there are.
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

// The same for those of all nodes for which holds(element, corners); all threads look for them.
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
