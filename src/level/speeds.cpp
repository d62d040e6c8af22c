// SPDX-License-Identifier: BSD-3-Clause
#include "level/speeds.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs {

template <int Dim>
Speeds speeds_of(const Level<Dim>& level) {
  const Communicator& comm = *level.comm;
  const Nodes<Dim>& nodes = level.nodes;
  const auto scaled = [&](std::int64_t i) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) square += nodes.v[k](i) * nodes.v[k](i);
    return std::sqrt(square) / nodes.d(i);
  };
  // Forces move a node by at most max_move per step. The clearance from the boundary may move it
  // farther, and back and forth between two sheets without end.
  const double by_force = level.settings.motion.max_move / level.settings.motion.dt;
  Speeds speeds;
  speeds.max =
      comm.allreduce_max(max_of("pnpbs::largest_speed", nodes.count, 0.0, [&](std::int64_t i) {
        return nodes.owned(i) ? std::min(scaled(i), by_force) : 0.0;
      }));
  const FixedPointSum sum =
      fixed_point_sum_of("pnpbs::mean_speed", nodes.count,
                         [&](std::int64_t i) { return nodes.owned(i) ? scaled(i) : 0.0; });
  const std::uint64_t moving =
      comm.allreduce_sum(sum_of("pnpbs::moving_nodes", nodes.count, [&](std::int64_t i) {
        return nodes.owned(i) != 0 && nodes.moves(i);
      }));
  speeds.mean =
      comm.allreduce_sum(sum).value() / static_cast<double>(std::max<std::uint64_t>(1, moving));
  return speeds;
}

template Speeds speeds_of(const Level<2>&);
template Speeds speeds_of(const Level<3>&);

}  // namespace pnpbs
