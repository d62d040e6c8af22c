// SPDX-License-Identifier: BSD-3-Clause
#include "placement/flat_elements.hpp"

#include <array>

#include "delaunay/volume/circumsphere.hpp"
#include "delaunay/volume/element_rule.hpp"

namespace pnpbs {

namespace {

bool is_flat(const Tetrahedron& t) { return circumsphere({t[0].x, t[1].x, t[2].x, t[3].x}).flat; }

}  // namespace

FoundNodes<3> flat_elements(const Level<3>& level, std::vector<Point<3>>& places) {
  const Nodes<3>& nodes = level.nodes;
  FoundNodes<3> found;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
      const Tetrahedron t =
          ordered_by_id(tetrahedron_of(nodes, {i, others[0], others[1], others[2]}));
      if (t[0].id != nodes.id(i) || !is_flat(t)) return;
      found.add(1, nodes.id(i), nodes.position(i));
      for (const VolumeNode& corner : t) places.push_back(corner.x);
    });
  }
  return over_ranks(*level.comm, found);
}

}  // namespace pnpbs
