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
  // never was. The plan counts the places as they are once the others are dropped. Changes no node.
  template <class KnownLeaf>
  std::int64_t pack_leaving(const Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
                            std::vector<Bytes>& outgoing, View<std::int32_t>& stay) const;

  // Allocates memory for the nodes that have arrived, besides those that stay.
  static void reserve(Nodes<Dim>& nodes, std::int64_t kept, const std::vector<Bytes>& incoming);

  // Once the nodes that do not stay are dropped: marks those that have drifted to other ranks as
  // ghosts, appends the ghosts that have arrived and the nodes that have drifted to us, and
  // completes the plan. If it throws, the nodes are right all the same.
  void append_arriving(Nodes<Dim>& nodes, const std::vector<Bytes>& incoming) const;
};

template <int Dim>
template <class KnownLeaf>
std::int64_t NodeExchange<Dim>::pack_leaving(const Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
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
    stay(kept++) = static_cast<std::int32_t>(i);
  }
  return kept;
}

template <int Dim>
void NodeExchange<Dim>::reserve(Nodes<Dim>& nodes, std::int64_t kept,
                                const std::vector<Bytes>& incoming) {
  std::size_t bytes = 0;
  for (const Bytes& message : incoming) bytes += message.size();
  nodes.reserve_with_room(kept + static_cast<std::int64_t>(bytes / sizeof(PackedNode<Dim>)));
}

template <int Dim>
void NodeExchange<Dim>::append_arriving(Nodes<Dim>& nodes,
                                        const std::vector<Bytes>& incoming) const {
  plan.for_received([&](std::int32_t i) { nodes.owned(i) = false; });
  const std::int64_t kept = nodes.count;
  reserve(nodes, kept, incoming);
  std::int32_t leaf = -1;  // nodes of the same one come together
  for_records<PackedNode<Dim>>(incoming, [&](const PackedNode<Dim>& node) {
    leaf = tree.leaf_at(node.x, leaf);
    append(nodes, node, distribution.owns(leaf));
  });
  for (std::int64_t i = kept; i < nodes.count; ++i) {
    leaf = tree.leaf_at(nodes.position(i), leaf);
    const auto node = static_cast<std::int32_t>(i);
    if (nodes.owned(i))
      halo.for_ranks(leaf, [&](int r) { plan.send(r, node); });
    else
      plan.receive(distribution.owner(leaf), node);
  }
  plan.build(nodes);
}

}  // namespace pnpbs
