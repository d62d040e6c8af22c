// SPDX-License-Identifier: BSD-3-Clause
// The boundary nodes that are to be stored in a level. Nodes with id -1 get a new id. A rank may
// list any of them, but must list all that it will own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "initial/incoming_nodes.hpp"
#include "level/level_geometry.hpp"

namespace pnpbs {

template <int Dim>
class BoundaryNodes;

// Boundary nodes in the plane: those of the discretized boundary.
template <>
class BoundaryNodes<2> {
 public:
  // `ids` are the ids that the nodes keep, or -1 for a new one. If it is empty, all are new.
  explicit BoundaryNodes(const Boundary& boundary, std::vector<std::int64_t> ids = {})
      : boundary_(boundary), ids_(std::move(ids)) {
    ids_.resize(boundary_.nodes.size(), -1);
  }

  std::size_t size() const { return boundary_.nodes.size(); }
  std::int64_t id(std::size_t b) const { return ids_[b]; }
  const Point<2>& position(std::size_t b) const { return boundary_.nodes[b].position; }
  void put(Nodes<2>& nodes, std::int64_t i, std::size_t b, std::int64_t id) const {
    const BoundaryNode<2>& at = boundary_.nodes[b];
    nodes.put(i, at.position, 1, id, at.tag, Carrier::fixed, static_cast<std::int32_t>(b));
  }

 private:
  const Boundary& boundary_;
  std::vector<std::int64_t> ids_;
};

// The sort key of boundary nodes. Among nodes at the same point, those with the least freedom are
// first, and those with an id before those without.
inline auto by_place(const IncomingNode<3>& node) {
  return std::tuple(node.position, node.carrier, node.boundary_node,
                    static_cast<std::uint64_t>(node.id), node.d, node.tag);
}

// Boundary nodes in space: those on curves and surfaces, sorted by position, so that nothing
// depends on where they came from. If several are at the same point, as where a bubble on a surface
// has reached a corner, the one with the least freedom is kept.
template <>
class BoundaryNodes<3> {
 public:
  explicit BoundaryNodes(IncomingNodes<3> nodes) : nodes_(std::move(nodes)) {
    std::sort(nodes_.begin(), nodes_.end(), [](const IncomingNode<3>& a, const IncomingNode<3>& b) {
      return by_place(a) < by_place(b);
    });
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end(),
                             [](const IncomingNode<3>& a, const IncomingNode<3>& b) {
                               return a.position == b.position;
                             }),
                 nodes_.end());
  }

  std::size_t size() const { return nodes_.size(); }
  std::int64_t id(std::size_t b) const { return nodes_[b].id; }
  const Point<3>& position(std::size_t b) const { return nodes_[b].position; }
  Carrier carrier(std::size_t b) const { return nodes_[b].carrier; }
  void put(Nodes<3>& nodes, std::int64_t i, std::size_t b, std::int64_t id) const {
    const IncomingNode<3>& at = nodes_[b];
    nodes.put(i, at.position, 1, id, at.tag, at.carrier, at.boundary_node);
  }

 private:
  IncomingNodes<3> nodes_;
};

}  // namespace pnpbs
