// SPDX-License-Identifier: BSD-3-Clause
// Numbers for where the nodes of a level are, of all ranks: nodes that come, go or move by a bit
// change them.
#pragma once

#include <cstdint>

#include "base/mixed_hash.hpp"
#include "level/level.hpp"

namespace pnpbs {

// The sum over all nodes of with(i, hash of its id and position); a sum, so that it has no order.
// The same on all ranks, however the nodes are distributed. Collective.
template <int Dim, class With>
std::uint64_t sum_of_node_hashes(const Level<Dim>& level, const With& with) {
  const Nodes<Dim>& nodes = level.nodes;
  return level.comm->allreduce_sum(
      sum_of("pnpbs::sum_of_node_hashes", nodes.count, [&](std::int64_t i) -> std::uint64_t {
        if (!nodes.owned(i)) return 0;
        std::uint64_t h = mixed(static_cast<std::uint64_t>(nodes.id(i)));
        for (int k = 0; k < Dim; ++k) h = mixed_with(h, nodes.x[k](i));
        return with(i, h);
      }));
}

// Of all that the stars depend on: d, too. Never 0. Collective.
std::uint64_t node_digest(const Level<3>& level);

}  // namespace pnpbs
