// SPDX-License-Identifier: BSD-3-Clause
// Exchange of nodes between ranks. Nodes that have drifted into leaves of other ranks migrate, and
// copies go to the ranks that need them as ghosts. The exchange also builds the halo exchange plan.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/nodes.hpp"
#include "partition/distribution.hpp"
#include "partition/halo_exchange.hpp"
#include "partition/packed_node.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// One exchange: the tree, its distribution, the halo and the plan that is filled.
template <int Dim>
struct NodeExchange {
  const BackgroundTree<Dim>& tree;
  const Distribution<Dim>& distribution;
  const Halo& halo;
  int rank;
  HaloExchange<Dim>& plan;  // must be started with the neighbours of the halo
  // Returns the boundary_node of a node as seen from a copy of the periodic cell.
  BoundarySeenFrom<Dim> boundary_seen_from;

  // Packs the nodes for rank r into outgoing[plan.place(r)]. Writes the indices of the nodes that
  // this rank keeps, as owner or as ghost, to `stay` in increasing order and returns their number.
  // `known_leaf(i)`: the last known leaf of node i, or -1. The plan gets the indices that the nodes
  // have once the others are removed. Does not change the nodes.
  template <class KnownLeaf>
  std::int64_t pack_leaving(const Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
                            std::vector<Bytes>& outgoing, View<std::int32_t>& stay) const;

  // Reserves memory for the nodes that have arrived after the first `kept`.
  static void reserve(Nodes<Dim>& nodes, std::int64_t kept, const std::vector<Bytes>& incoming);

  // Marks migrated nodes as ghosts, appends the nodes and ghosts that have arrived, and builds the
  // plan. Nodes that do not stay must have been removed. If it throws, the nodes are still valid.
  void append_arriving(Nodes<Dim>& nodes, std::vector<Bytes> incoming) const;

 private:
  // Returns the id of a node, which this rank has owned, in the copy of the cell that it has moved
  // to with its new owner.
  std::int64_t id_in_copy_of(int owner, std::int64_t id) const {
    return plan.images().translation_from(owner).id(id);
  }
  // Returns a node that this rank has owned as rank `to` will have it. In a periodic domain, the
  // node may have left the cell.
  PackedNode<Dim> seen_by(int to, const Nodes<Dim>& nodes, std::int64_t i) const {
    PackedNode<Dim> node = packed(nodes, i);
    const PeriodicCell<Dim>& cell = plan.images().cell();
    if (!cell.any()) return node;
    node.id += PeriodicCell<Dim>::id_shift(cell.image_of(node.x));
    node.translate(plan.images().translation_to(to), boundary_seen_from);
    return node;
  }
};

template <int Dim>
template <class KnownLeaf>
std::int64_t NodeExchange<Dim>::pack_leaving(const Nodes<Dim>& nodes, const KnownLeaf& known_leaf,
                                             std::vector<Bytes>& outgoing,
                                             View<std::int32_t>& stay) const {
  std::vector<std::vector<std::int32_t>> packed_for(outgoing.size());
  const auto pack_for = [&](int r, std::int64_t i) {
    if (plan.knows(r)) packed_for[plan.place(r)].push_back(static_cast<std::int32_t>(i));
  };
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
    if (!ours) pack_for(owner, i);
    halo.for_ranks(leaf, [&](int r) {
      if (r == rank)
        stays = true;
      else
        pack_for(r, i);
      if (ours) plan.send(r, static_cast<std::int32_t>(kept));
    });
    if (!stays) continue;
    if (!ours) plan.receive(owner, static_cast<std::int32_t>(kept));
    stay(kept++) = static_cast<std::int32_t>(i);
  }
  // The messages are among the largest data of a rank, so their memory is exact.
  for (std::size_t k = 0; k < outgoing.size(); ++k) {
    const std::vector<std::int32_t> indices = std::exchange(packed_for[k], {});
    std::size_t bytes = 0;
    const int to = plan.neighbours()[k];
    for (const std::int32_t i : indices) bytes += NodeMessage<Dim>::bytes_of(seen_by(to, nodes, i));
    outgoing[k].reserve(bytes);
    for (const std::int32_t i : indices)
      NodeMessage<Dim>::append(outgoing[k], seen_by(to, nodes, i));
  }
  return kept;
}

template <int Dim>
void NodeExchange<Dim>::reserve(Nodes<Dim>& nodes, std::int64_t kept,
                                const std::vector<Bytes>& incoming) {
  for (const Bytes& message : incoming)
    NodeMessage<Dim>::for_nodes(message, [&](const PackedNode<Dim>&) { ++kept; });
  nodes.reserve_with_room(kept);
}

template <int Dim>
void NodeExchange<Dim>::append_arriving(Nodes<Dim>& nodes, std::vector<Bytes> incoming) const {
  for (const int owner : plan.neighbours())
    for (const std::int32_t i : plan.received_from(owner)) {
      nodes.owned(i) = false;
      if (plan.images().cell().any()) nodes.id(i) = id_in_copy_of(owner, nodes.id(i));
    }
  const std::int64_t kept = nodes.count;
  reserve(nodes, kept, incoming);
  std::int32_t leaf = -1;  // start of the search, because consecutive nodes often share a leaf
  for (Bytes& message : incoming) {
    NodeMessage<Dim>::for_nodes(message, [&](const PackedNode<Dim>& node) {
      leaf = tree.leaf_at(node.x, leaf);
      append(nodes, node, distribution.owns(leaf));
    });
    message = {};  // Frees its memory before the plan takes more.
  }
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
