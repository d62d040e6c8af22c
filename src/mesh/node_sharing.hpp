// SPDX-License-Identifier: BSD-3-Clause
// Which ranks share a node: its owner, and those that have it in an element they own.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_records.hpp"

namespace pnpbs {

struct NodeShare {
  std::int64_t node;  // its number
  std::int32_t rank;  // another one that has it
};

// For all nodes that this rank shares, by number and rank. others: the nodes of its elements that
// other ranks own. Collective.
std::vector<NodeShare> node_sharing(const Communicator& comm, const RankRanges& nodes,
                                    const std::vector<std::int64_t>& others);

}  // namespace pnpbs
