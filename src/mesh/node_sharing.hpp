// SPDX-License-Identifier: BSD-3-Clause
// Ranks that share a node: its owner, and the ranks that own an element at it.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_records.hpp"

namespace pnpbs {

struct NodeShare {
  std::int64_t node;  // global number
  std::int32_t rank;  // another rank that has the node
};

// Returns the shares of all nodes that this rank has in common with others, sorted by node and
// rank. `others`: the nodes of owned elements that other ranks own. Collective.
std::vector<NodeShare> node_sharing(const Communicator& comm, const RankRanges& nodes,
                                    const std::vector<std::int64_t>& others);

}  // namespace pnpbs
