// SPDX-License-Identifier: BSD-3-Clause
// A finishing sweep in space: every moving node moves part of the way to the mean of its Delaunay
// neighbours. All nodes move from their old positions (Jacobi). The sweep improves tetrahedra on
// average and does not remove slivers.
#pragma once

#include <cstdint>

#include "base/nodes.hpp"
#include "base/nodes_worked_for.hpp"
#include "dynamics/schemes.hpp"

namespace pnpbs {

// Moves the owned nodes with a closed star by `share` of the way to the mean. A node stays where it
// is if allowed(i, x) is false for the new position x. `stars` must visit neighbours in an order
// that depends on ids only. `proposed` is a scratch array with one entry per node. Returns the
// number of nodes for which a mean was computed.
template <class Stars, class Allowed>
NodesWorkedFor sweep_to_means(Nodes<3>& nodes, const Stars& stars, double share, Field<3>& proposed,
                              const Allowed& allowed) {
  const auto has_goal = [&](std::int64_t i) {
    return nodes.owned(i) && nodes.moves(i) && stars.closed(i);
  };
  for_each("pnpbs::sweep_to_means::propose", nodes.count, [&](std::int64_t i) {
    const Point<3> x = nodes.position(i);
    Point<3> goal = x;
    if (has_goal(i)) {
      Point<3> sum{};
      double neighbours = 0;
      stars.for_neighbours(i, [&](std::int64_t j) {
        for (int k = 0; k < 3; ++k) sum[k] += nodes.x[k](j);
        ++neighbours;
      });
      for (std::size_t k = 0; k < 3; ++k) goal[k] += share * (sum[k] / neighbours - x[k]);
      if (!allowed(i, goal)) goal = x;
    }
    for (int k = 0; k < 3; ++k) proposed[k](i) = goal[k];
  });
  for_each("pnpbs::sweep_to_means::go", nodes.count,
           [&](std::int64_t i) { nodes.set_position(i, point_at<3>(proposed, i)); });
  nodes.moved();
  return nodes_worked_for(nodes, has_goal);
}

}  // namespace pnpbs
