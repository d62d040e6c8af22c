// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/node_sharing.hpp"

#include <algorithm>

namespace pnpbs {

namespace {

void sort(std::vector<NodeShare>& shares) {
  std::ranges::sort(shares, [](const NodeShare& a, const NodeShare& b) {
    return a.node != b.node ? a.node < b.node : a.rank < b.rank;
  });
}

// Returns, for owned nodes, the other ranks that have them in an owned element. Collective.
std::vector<NodeShare> claims_on_owned(const Communicator& comm, const RankRanges& nodes,
                                       const std::vector<std::int64_t>& others) {
  Outbox outgoing;
  for (const std::int64_t node : others) pack(outgoing.to(nodes.owner(node)), node);
  std::vector<NodeShare> claims;
  for (const Message& message : comm.sparse_all_to_all(outgoing.messages()))
    for_records<std::int64_t>(message.bytes, [&](std::int64_t node) {
      claims.push_back({node, message.rank});
    });
  sort(claims);
  return claims;
}

}  // namespace

std::vector<NodeShare> node_sharing(const Communicator& comm, const RankRanges& nodes,
                                    const std::vector<std::int64_t>& others) {
  const std::vector<NodeShare> claims = claims_on_owned(comm, nodes, others);
  Outbox outgoing;
  for (auto begin = claims.begin(); begin != claims.end();) {
    const auto end = std::find_if(
        begin, claims.end(), [&](const NodeShare& claim) { return claim.node != begin->node; });
    std::vector<std::int32_t> ranks{comm.rank()};
    for (auto claim = begin; claim != end; ++claim) ranks.push_back(claim->rank);
    for (const std::int32_t to : ranks)
      for (const std::int32_t other : ranks)
        if (other != to) pack(outgoing.to(to), NodeShare{begin->node, other});
    begin = end;
  }
  std::vector<NodeShare> shares = deliver<NodeShare>(comm, outgoing);
  sort(shares);
  return shares;
}

}  // namespace pnpbs
