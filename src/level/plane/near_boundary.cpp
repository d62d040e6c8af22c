// SPDX-License-Identifier: BSD-3-Clause
#include "level/plane/near_boundary.hpp"

#include "geometry/clearance.hpp"
#include "method/constants.hpp"

namespace pnpbs {

NearEdges NearBoundary<2>::near_leaves(const LevelTree<2>& tree, double radius) {
  NearEdges edges;
  edges.prepare(tree.map(), *tree.links(), radius);
  return edges;
}

void NearBoundary<2>::build(const Nodes<2>& nodes, const Field<2>& at, const Buckets<2>& buckets,
                            const SizedTree<2>& map, const LevelGeometry<2>& geometry) {
  edges_.build(nodes, at, buckets, map);
  visibility_.look(nodes, edges_, map, geometry.sectors());
}

Point<2> NearBoundary<2>::hold_off(std::int64_t i, const Nodes<2>& nodes, const SizedTree<2>& map,
                                   const LevelGeometry<2>&, const Point<2>& to) const {
  const Point<2> from = nodes.position(i);
  if (edges_.stays_clear(i, from, to, method::kBoundaryClearance * nodes.d(i))) return to;
  return clear_position(map, edges_.edges_of(i), from, to, nodes.d(i)).position;
}

}  // namespace pnpbs
