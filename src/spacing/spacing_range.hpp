// SPDX-License-Identifier: BSD-3-Clause
// The least and the largest d of the nodes of all ranks.
#pragma once

#include "base/nodes.hpp"
#include "comm/communicator.hpp"

namespace pnpbs {

struct SpacingRange {
  double min, max;
  bool empty() const { return min > max; }
};

// d(i): of node i. Collective.
template <int Dim, class Spacing>
SpacingRange spacing_range(const Communicator& comm, const Nodes<Dim>& nodes, const Spacing& d) {
  const auto max = [&](double sign) {
    return comm.allreduce_max(
        max_of("pnpbs::spacing_range", nodes.count, -kFarAway,
               [&](std::int64_t i) { return nodes.owned(i) ? sign * d(i) : -kFarAway; }));
  };
  const double min = -max(-1);
  return {min, max(1)};
}

template <int Dim>
SpacingRange spacing_range(const Communicator& comm, const Nodes<Dim>& nodes) {
  return spacing_range<Dim>(comm, nodes, [&](std::int64_t i) { return nodes.d(i); });
}

}  // namespace pnpbs
