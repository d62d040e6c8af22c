// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/added_nodes.hpp"

#include <utility>

#include "level/kept_node.hpp"
#include "level/numbering.hpp"

namespace pnpbs {

std::int64_t add_nodes(Level<3>& level, IncomingNodes<3> more) {
  const auto added = static_cast<std::int64_t>(level.comm->allreduce_sum(more.size()));
  if (added == 0) return 0;
  const Nodes<3>& nodes = level.nodes;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i)) more.push_back(kept_node(nodes, i));
  IncomingNodes<3> inner, laid;
  for (const IncomingNode<3>& node : more) (node.is_inner() ? inner : laid).push_back(node);
  find_leaves(level, inner);
  sort_by_leaf(level, inner);
  number_and_store(level, std::move(inner), BoundaryNodes<3>(std::move(laid)));
  return added;
}

}  // namespace pnpbs
