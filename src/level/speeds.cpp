// SPDX-License-Identifier: BSD-3-Clause
#include "level/speeds.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs {

Speeds speeds_of(const Level& level) {
  const Communicator& comm = *level.comm;
  const Nodes<2>& nodes = level.nodes;
  const auto scaled = [&](std::int64_t i) {
    return std::sqrt(nodes.v[0](i) * nodes.v[0](i) + nodes.v[1](i) * nodes.v[1](i)) / nodes.d(i);
  };
  Speeds speeds;
  speeds.max =
      comm.allreduce_max(max_of("pnpbs::largest_speed", nodes.count, 0.0,
                                [&](std::int64_t i) { return nodes.owned(i) ? scaled(i) : 0.0; }));
  const std::uint64_t sum = sum_of("pnpbs::mean_speed", nodes.count, [&](std::int64_t i) {
    return nodes.owned(i) ? fixed_point(scaled(i)) : 0;
  });
  const auto all = static_cast<std::int64_t>(
      comm.allreduce_sum(static_cast<std::uint64_t>(level.owned_count())));
  const std::int64_t moving = std::max<std::int64_t>(1, all - level.ground.boundary_nodes());
  speeds.mean = from_fixed_point(comm.allreduce_sum(sum)) / static_cast<double>(moving);
  return speeds;
}

}  // namespace pnpbs
