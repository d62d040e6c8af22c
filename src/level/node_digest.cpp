// SPDX-License-Identifier: BSD-3-Clause
#include "level/node_digest.hpp"

#include <algorithm>

#include "base/mixed_hash.hpp"

namespace pnpbs {

// A sum over the nodes, so that it has no order.
template <int Dim>
std::uint64_t node_digest(const Level<Dim>& level) {
  const Nodes<Dim>& nodes = level.nodes;
  const std::uint64_t own =
      sum_of("pnpbs::node_digest", nodes.count, [&](std::int64_t i) -> std::uint64_t {
        if (!nodes.owned(i)) return 0;
        std::uint64_t h = mixed(static_cast<std::uint64_t>(nodes.id(i)));
        for (int k = 0; k < Dim; ++k) h = mixed_with(h, nodes.x[k](i));
        return mixed_with(h, nodes.d(i));
      });
  return std::max<std::uint64_t>(level.comm->allreduce_sum(own), 1);
}

template std::uint64_t node_digest(const Level<2>&);
template std::uint64_t node_digest(const Level<3>&);

}  // namespace pnpbs
