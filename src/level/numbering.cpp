// SPDX-License-Identifier: BSD-3-Clause
#include "level/numbering.hpp"

#include <algorithm>
#include <tuple>

#include "base/counting_sort.hpp"
#include "level/exchange.hpp"
#include "level/node_spacing.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

// Positions are sorted by their last coordinate first.
template <int Dim>
Point<Dim> reversed(Point<Dim> x) {
  std::reverse(x.begin(), x.end());
  return x;
}

// Returns a sort key for nodes at the same point, so that their order does not depend on memory.
auto kind_of(const IncomingNode<2>& node) { return node.inner; }
auto kind_of(const IncomingNode<3>& node) {
  return std::tuple(node.carrier, node.boundary_node, node.tag);
}

}  // namespace

template <int Dim>
void find_leaves(const Level<Dim>& level, IncomingNodes<Dim>& incoming) {
  for_each("pnpbs::find_leaves", static_cast<std::int64_t>(incoming.size()), [&](std::int64_t k) {
    IncomingNode<Dim>& node = incoming[static_cast<std::size_t>(k)];
    put_in_cell(level, node);
    node.leaf = node.is_inner() ? level.tree->tree().leaf_at(node.position) : -1;
  });
}

template <int Dim>
std::vector<std::int32_t> sort_by_leaf(const Level<Dim>& level, IncomingNodes<Dim>& incoming) {
  const std::int32_t leaves = level.tree->tree().leaf_count();
  const auto leaf_of = [&](std::int64_t k) { return incoming[static_cast<std::size_t>(k)].leaf; };
  CountingSort by_leaf(static_cast<std::int64_t>(incoming.size()), leaves, leaf_of);
  std::vector<std::int32_t> begin = by_leaf.start();
  IncomingNodes<Dim> sorted(static_cast<std::size_t>(begin.back()));
  by_leaf.for_places(leaf_of, [&](std::int64_t k, std::int32_t place) {
    sorted[static_cast<std::size_t>(place)] = incoming[static_cast<std::size_t>(k)];
  });
  incoming = std::move(sorted);
  for_each("pnpbs::sort_by_leaf", leaves, [&](std::int64_t leaf) {
    const auto at = static_cast<std::size_t>(leaf);
    std::sort(incoming.begin() + begin[at], incoming.begin() + begin[at + 1],
              [](const IncomingNode<Dim>& a, const IncomingNode<Dim>& b) {
                return std::tuple(reversed<Dim>(a.position), a.id, a.d, kind_of(a)) <
                       std::tuple(reversed<Dim>(b.position), b.id, b.d, kind_of(b));
              });
  });
  return begin;
}

namespace {

struct LeafNode {
  std::int32_t leaf, node;  // leaf, and index of the boundary node
};

// A sequence of boundary and inner nodes, both sorted by leaf: leaf by leaf, and boundary nodes
// first. Threads process it in blocks of leaves.
template <int Dim>
class LeafBlocks {
 public:
  LeafBlocks(std::int32_t leaves, const std::vector<LeafNode>& boundary,
             const IncomingNodes<Dim>& inner)
      : leaves_(leaves), boundary_(boundary), inner_(inner) {}

  // Calls of_boundary(index in the sequence, node) or of_inner(index in the sequence, node) for
  // every node.
  template <class OfBoundary, class OfInner>
  void for_each_node(const OfBoundary& of_boundary, const OfInner& of_inner) const {
    constexpr std::int32_t kBlock = 256;
    for_each("pnpbs::LeafBlocks", (leaves_ + kBlock - 1) / kBlock, [&](std::int64_t block) {
      const auto first = static_cast<std::int32_t>(block) * kBlock;
      const auto before = [](const auto& node, std::int32_t leaf) { return node.leaf < leaf; };
      const auto place_of = [&](const auto& nodes) {
        return static_cast<std::size_t>(
            std::lower_bound(nodes.begin(), nodes.end(), first, before) - nodes.begin());
      };
      std::size_t b = place_of(boundary_), k = place_of(inner_);
      for (std::int32_t leaf = first; leaf < std::min(first + kBlock, leaves_); ++leaf) {
        for (; b < boundary_.size() && boundary_[b].leaf == leaf; ++b)
          of_boundary(b + k, boundary_[b]);
        for (; k < inner_.size() && inner_[k].leaf == leaf; ++k) of_inner(b + k, inner_[k]);
      }
    });
  }

 private:
  std::int32_t leaves_;
  const std::vector<LeafNode>& boundary_;
  const IncomingNodes<Dim>& inner_;
};

// Removes all but the first of the nodes at the same point, because forces cannot separate them.
// The nodes must be sorted by sort_by_leaf().
template <int Dim>
void leave_out_coinciding(IncomingNodes<Dim>& inner) {
  const auto same_place = [](const IncomingNode<Dim>& a, const IncomingNode<Dim>& b) {
    return a.position == b.position;
  };
  const std::int64_t pairs = std::max<std::int64_t>(1, static_cast<std::int64_t>(inner.size())) - 1;
  const std::uint64_t coinciding = sum_of("pnpbs::coinciding", pairs, [&](std::int64_t n) {
    const auto k = static_cast<std::size_t>(n);
    return same_place(inner[k], inner[k + 1]);
  });
  if (coinciding > 0) inner.erase(std::unique(inner.begin(), inner.end(), same_place), inner.end());
}

// Returns the boundary nodes that this rank owns, sorted by leaf.
template <int Dim>
std::vector<LeafNode> own_boundary_nodes(const Level<Dim>& level, const BoundaryNodes<Dim>& laid) {
  std::vector<LeafNode> own;
  for (std::size_t b = 0; b < laid.size(); ++b) {
    const std::int32_t leaf = level.tree->tree().leaf_at(laid.position(b));
    if (level.tree->owns(leaf)) own.push_back({leaf, static_cast<std::int32_t>(b)});
  }
  std::sort(own.begin(), own.end(), [](const LeafNode& a, const LeafNode& b) {
    return std::tie(a.leaf, a.node) < std::tie(b.leaf, b.node);
  });
  return own;
}

// Returns the largest id of all ranks. It is reduced in two parts, because a double cannot hold
// every id.
std::int64_t largest_of_ranks(const Communicator& comm, std::int64_t id) {
  constexpr std::int64_t kPart = std::int64_t{1} << 32;
  const auto high = static_cast<std::int64_t>(comm.allreduce_max(static_cast<double>(id / kPart)));
  const auto low = static_cast<std::int64_t>(
      comm.allreduce_max(id / kPart == high ? static_cast<double>(id % kPart) : 0.0));
  return high * kPart + low;
}

// Returns an id that is larger than all ids on this rank.
template <int Dim>
std::int64_t next_id_after(const Level<Dim>& level, const IncomingNodes<Dim>& incoming) {
  std::int64_t next = level.next_id;
  for (const IncomingNode<Dim>& node : incoming)
    next = std::max(next, level.nodes.cell.number_of(node.id) + 1);
  return next;
}

// Returns for each leaf the first new id of its nodes without one. Advances level.next_id.
template <int Dim, class BoundaryId>
std::vector<std::int64_t> new_ids(Level<Dim>& level, const LeafBlocks<Dim>& blocks,
                                  const BoundaryId& boundary_id) {
  std::vector<std::int64_t> next(static_cast<std::size_t>(level.tree->tree().leaf_count()), 0);
  blocks.for_each_node(
      [&](std::size_t, const LeafNode& node) {
        next[static_cast<std::size_t>(node.leaf)] += boundary_id(node) < 0;
      },
      [&](std::size_t, const IncomingNode<Dim>& node) {
        next[static_cast<std::size_t>(node.leaf)] += node.id < 0;
      });
  return level.tree->distribution().prefix_sums(*level.comm, std::move(next), level.next_id);
}

}  // namespace

template <int Dim>
void reserve_ids(Level<Dim>& level, const IncomingNodes<Dim>& incoming) {
  level.next_id = largest_of_ranks(*level.comm, next_id_after(level, incoming));
}

// New ids follow the Morton order of the leaves, in a leaf the boundary nodes before the inner
// ones, and then the positions. The order of ids is then nearly that in memory.
template <int Dim>
void number_and_store(Level<Dim>& level, IncomingNodes<Dim> inner, BoundaryNodes<Dim> laid) {
  leave_out_coinciding<Dim>(inner);
  level.next_id = next_id_after(level, inner);
  for (std::size_t b = 0; b < laid.size(); ++b)
    level.next_id = std::max(level.next_id, level.nodes.cell.number_of(laid.id(b)) + 1);
  level.next_id = largest_of_ranks(*level.comm, level.next_id);
  const std::vector<LeafNode> own_boundary = own_boundary_nodes(level, laid);
  const LeafBlocks<Dim> blocks(level.tree->tree().leaf_count(), own_boundary, inner);
  const auto boundary_id = [&](const LeafNode& node) {
    return laid.id(static_cast<std::size_t>(node.node));
  };
  std::vector<std::int64_t> next = new_ids(level, blocks, boundary_id);
  const auto number = [&](std::int64_t id, std::int32_t leaf) {
    return id >= 0 ? id : level.nodes.cell.id_of(next[static_cast<std::size_t>(leaf)]++);
  };
  const auto count = static_cast<std::int64_t>(own_boundary.size() + inner.size());
  Nodes<Dim>& nodes = level.nodes;
  // Reserve memory for insertions and, on several ranks, for ghosts.
  nodes.reset(count, count + count / (level.distributed() ? 16 : 64) + 64);
  const View<std::int32_t> bucket = level.neighbourhood.reset_buckets(nodes);
  blocks.for_each_node(
      [&](std::size_t place, const LeafNode& node) {
        const auto i = static_cast<std::int64_t>(place);
        laid.put(nodes, i, static_cast<std::size_t>(node.node),
                 number(boundary_id(node), node.leaf));
        bucket(i) = node.leaf;
      },
      [&](std::size_t place, const IncomingNode<Dim>& node) {
        const auto i = static_cast<std::int64_t>(place);
        nodes.put(i, node.position, 1, number(node.id, node.leaf), 0, Carrier::free, -1);
        bucket(i) = node.leaf;
      });
  refresh_spacing(level);
  exchange(level, step_hops(level.settings));
}

template void find_leaves(const Level<2>&, IncomingNodes<2>&);
template void find_leaves(const Level<3>&, IncomingNodes<3>&);
template std::vector<std::int32_t> sort_by_leaf(const Level<2>&, IncomingNodes<2>&);
template std::vector<std::int32_t> sort_by_leaf(const Level<3>&, IncomingNodes<3>&);
template void reserve_ids(Level<3>&, const IncomingNodes<3>&);
template void number_and_store(Level<2>&, IncomingNodes<2>, BoundaryNodes<2>);
template void number_and_store(Level<3>&, IncomingNodes<3>, BoundaryNodes<3>);

}  // namespace pnpbs
