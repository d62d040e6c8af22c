// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra of a level, each once over all ranks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "delaunay/volume/element_rule.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Calls visit(element, corners) for the elements of which this rank owns the node with the least
// id: the nodes at the corners in the order of ids, so that the bits of what is computed of it do
// not depend on ranks, and the corners' memory indices. From the stars there are.
template <class Visit>
void for_own_elements(const Level<3>& level, const Visit& visit) {
  const Nodes<3>& nodes = level.nodes;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
      if (std::ranges::any_of(others, [&](auto j) { return nodes.id(j) < nodes.id(i); })) return;
      const std::array<std::int64_t, 4> corners{i, others[0], others[1], others[2]};
      visit(ordered_by_id(tetrahedron_of(nodes, corners)), corners);
    });
  }
}

}  // namespace pnpbs
