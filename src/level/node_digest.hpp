// SPDX-License-Identifier: BSD-3-Clause
// Digests of the nodes of a level over all ranks. They change if a node appears, vanishes or moves
// by a single bit.
#pragma once

#include <cstdint>

#include "base/mixed_hash.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Returns the sum over all nodes of with(i, hash of its id and position). A sum does not depend on
// the order. It is the same on all ranks, however the nodes are distributed. Collective.
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

// Returns a digest of everything that stars depend on, which includes d. It is never 0. Collective.
std::uint64_t node_digest(const Level<3>& level);

}  // namespace pnpbs
