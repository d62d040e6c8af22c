// SPDX-License-Identifier: BSD-3-Clause
// Nodes on their way between ranks: to the owners of the leaves they have drifted into, and as
// ghosts to those who need them. Every rank packs what others get, keeps what it owns or has as a
// ghost, and appends what comes; the plan of the halo exchange is made on the way.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "comm/records.hpp"
#include "partition/distribution.hpp"
#include "partition/halo_exchange.hpp"
#include "partition/packed_node.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
struct NodeExchange {
  const BackgroundTree<Dim>& tree;
  const Distribution<Dim>& distribution;
  const Halo& halo;
  int rank;
  HaloExchange<Dim>& plan;  // started with the neighbours of the halo

  // Of the nodes, which may have drifted: packs into outgoing[plan.place(r)] those that rank r
  // gets, writes the places of those that stay here to `stay`, in increasing order, and returns how
  // many these are. `known_leaf(i)`: the leaf that node i was in when that was last asked, -1 if it
  // never was. The plan counts the places as they are once the others are dropped.
  template <class KnownLeaf>
  std::int64_t pack_leaving(Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
                            std::vector<Bytes>& outgoing, View<std::int32_t>& stay) const;

  // Appends ghosts, and nodes that have drifted to us: those, others may have as ghosts.
  void append_arriving(Nodes<Dim>& nodes, const std::vector<Bytes>& incoming) const;
};

template <int Dim>
template <class KnownLeaf>
std::int64_t NodeExchange<Dim>::pack_leaving(Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
                                             std::vector<Bytes>& outgoing,
                                             View<std::int32_t>& stay) const {
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    const std::int32_t known = known_leaf(i);
    if (known >= 0 && halo.interior(known)) {
      stay(kept++) = static_cast<std::int32_t>(i);
      continue;
    }
    const std::int32_t leaf = tree.leaf_at(nodes.position(i), known);
    const int owner = distribution.owner(leaf);
    const bool ours = owner == rank;
    bool stays = ours;
    if (!ours && plan.knows(owner)) pack(outgoing[plan.place(owner)], packed(nodes, i));
    halo.for_ranks(leaf, [&](int r) {
      if (r == rank)
        stays = true;
      else if (plan.knows(r))
        pack(outgoing[plan.place(r)], packed(nodes, i));
      if (ours) plan.send(r, static_cast<std::int32_t>(kept));
    });
    if (!stays) continue;
    if (!ours) plan.receive(owner, static_cast<std::int32_t>(kept));
    nodes.owned(i) = ours;
    stay(kept++) = static_cast<std::int32_t>(i);
  }
  return kept;
}

template <int Dim>
void NodeExchange<Dim>::append_arriving(Nodes<Dim>& nodes,
                                        const std::vector<Bytes>& incoming) const {
  std::size_t bytes = 0;
  for (const Bytes& message : incoming) bytes += message.size();
  nodes.reserve_with_room(nodes.count + static_cast<std::int64_t>(bytes / sizeof(PackedNode<Dim>)));
  std::int32_t leaf = -1;  // nodes of the same one come together
  for_records<PackedNode<Dim>>(incoming, [&](const PackedNode<Dim>& node) {
    leaf = tree.leaf_at(node.x, leaf);
    const auto i = static_cast<std::int32_t>(nodes.count);
    append(nodes, node, distribution.owns(leaf));
    if (distribution.owns(leaf))
      halo.for_ranks(leaf, [&](int r) { plan.send(r, i); });
    else
      plan.receive(distribution.owner(leaf), i);
  });
  plan.build(nodes);
}

}  // namespace pnpbs
