// SPDX-License-Identifier: BSD-3-Clause
// Domain decomposition: cuts the graph of tree leaves into one part per rank, with METIS.
#pragma once

#include <cstdint>
#include <vector>

#include "tree/leaf_graph.hpp"

namespace pnpbs {

// Rank that owns each leaf. work[leaf] >= 0 in integers; leaves without work go with their
// neighbours in Morton order. Parts may be empty (more ranks than leaves with work). METIS cuts
// between leaves that interact; where it refuses or leaves work badly spread, Morton order is cut
// instead. The result depends on the seed; the nodes do not.
std::vector<std::int32_t> partition_leaves(const LeafGraph<2>& graph,
                                           const std::vector<std::int64_t>& work, int ranks,
                                           std::int64_t seed);

// Largest over mean work of the parts.
double imbalance(const std::vector<std::int32_t>& owner, const std::vector<std::int64_t>& work,
                 int ranks);

}  // namespace pnpbs
