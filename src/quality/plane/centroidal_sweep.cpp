// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/centroidal_sweep.hpp"

namespace pnpbs {

void centroidal_sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
                      const SizedTree<2>& map, const Embedding<2>& embedding, const SweepRule& rule,
                      Field<2>& proposed, View<char>& allowed) {
  const CellCentroids centroids(nodes, stars, embedding);
  for_each("pnpbs::centroidal_sweep", nodes.count, [&](std::int64_t i) {
    if (!centroids.has(i)) return propose_current_position(nodes, i, proposed);
    const Point<2> x = nodes.position(i), to = centroids.of(i);
    const Point<2> move{rule.weight * (to[0] - x[0]), rule.weight * (to[1] - x[1])};
    propose_move(nodes, near_edges, map, rule, i, move, proposed);
  });
  apply_allowed_moves(nodes, stars, rule, proposed, allowed);
}

}  // namespace pnpbs
