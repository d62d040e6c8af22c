// SPDX-License-Identifier: BSD-3-Clause
// The number of nodes and ghosts that a phase of a run computes for.
#pragma once

#include <cstdint>

#include "base/nodes.hpp"
#include "base/timers.hpp"

namespace pnpbs {

// Counts the nodes and ghosts i of a rank for which worked_for(i) is true, each once.
template <int Dim, class WorkedFor>
NodesWorkedFor nodes_worked_for(const Nodes<Dim>& nodes, const WorkedFor& worked_for) {
  return sums_over("pnpbs::nodes_worked_for", nodes.count, NodesWorkedFor(),
                   [&](std::int64_t i, NodesWorkedFor& sum) {
                     if (worked_for(i)) sum.add({1, nodes.owned(i) ? 1 : 0});
                   });
}

}  // namespace pnpbs
