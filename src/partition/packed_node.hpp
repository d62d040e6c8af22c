// SPDX-License-Identifier: BSD-3-Clause
// A node as ranks send it to each other: a plain record of all its fields.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>

#include "base/nodes.hpp"
#include "base/periodic_cell.hpp"
#include "comm/records.hpp"

namespace pnpbs {

template <int Dim>
struct PackedNode {
  std::int64_t id;
  Point<Dim> x, v, reference;
  double d;
  std::int32_t tag, boundary_node, reference_on;
  Carrier carrier;

  // Makes the node what it is as seen from a copy of the periodic cell.
  void translate(const Translation<Dim>& by, const BoundarySeenFrom<Dim>& boundary_seen_from) {
    id = by.id(id);
    x = by(x);
    reference = by(reference);
    boundary_node = boundary_seen_from(by.image, carrier, boundary_node);
    if (Dim == 3) reference_on = boundary_seen_from(by.image, carrier, reference_on);
  }
};

template <int Dim>
PackedNode<Dim> packed(const Nodes<Dim>& nodes, std::int64_t i) {
  return {nodes.id(i),
          nodes.position(i),
          point_at<Dim>(nodes.v, i),
          point_at<Dim>(nodes.reference, i),
          nodes.d(i),
          nodes.tag(i),
          nodes.boundary_node(i),
          Dim == 3 ? nodes.reference_on(i) : -1,
          nodes.carrier(i)};
}

template <int Dim>
void append(Nodes<Dim>& nodes, const PackedNode<Dim>& packed, bool owned) {
  nodes.append(packed.x, packed.d, packed.id, packed.tag, packed.carrier, packed.boundary_node);
  const std::int64_t i = nodes.count - 1;
  for (int k = 0; k < Dim; ++k) {
    nodes.v[k](i) = packed.v[k];
    nodes.reference[k](i) = packed.reference[k];
  }
  if constexpr (Dim == 3) nodes.reference_on(i) = packed.reference_on;
  nodes.owned(i) = owned;
}

// Messages of nodes in a form shorter than records: fields with the values that most nodes have are
// left out. Nothing is rounded.
template <int Dim>
class NodeMessage {
 public:
  static std::size_t bytes_of(const PackedNode<Dim>& node) {
    std::size_t bytes = sizeof(std::uint8_t);
    for_fields(node, usual_fields(node), [&](const auto& field) { bytes += sizeof field; });
    return bytes;
  }
  static void append(Bytes& message, const PackedNode<Dim>& node) {
    const std::uint8_t usual = usual_fields(node);
    pack(message, usual);
    for_fields(node, usual, [&](const auto& field) { pack(message, field); });
  }
  // Calls visit(node) for each node of a message.
  template <class Visit>
  static void for_nodes(const Bytes& message, const Visit& visit) {
    const char* at = message.data();
    const auto take = [&at](auto& field) {
      std::memcpy(&field, at, sizeof field);
      at += sizeof field;
    };
    while (at != message.data() + message.size()) {
      PackedNode<Dim> node{0, {}, {}, {}, 0, 0, -1, -1, Carrier::free};
      std::uint8_t usual = 0;
      take(usual);
      for_fields(node, usual, take);
      if (usual & kAtReference) {
        node.reference = node.x;
        node.reference_on = node.boundary_node;
      }
      visit(node);
    }
  }

 private:
  // Flags of what is left out: the reference is the position, the node is inner, or it is at rest.
  static constexpr std::uint8_t kAtReference = 1, kInner = 2, kAtRest = 4;

  static bool same_bits(const Point<Dim>& a, const Point<Dim>& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
  static std::uint8_t usual_fields(const PackedNode<Dim>& node) {
    const bool at_reference =
        same_bits(node.reference, node.x) && (Dim == 2 || node.reference_on == node.boundary_node);
    const bool inner = node.tag == 0 && node.boundary_node == -1;
    return static_cast<std::uint8_t>((at_reference ? kAtReference : 0) | (inner ? kInner : 0) |
                                     (same_bits(node.v, {}) ? kAtRest : 0));
  }
  template <class Node, class Visit>
  static void for_fields(Node& node, std::uint8_t usual, const Visit& visit) {
    visit(node.id);
    visit(node.x);
    visit(node.d);
    visit(node.carrier);
    if (!(usual & kAtRest)) visit(node.v);
    if (!(usual & kInner)) {
      visit(node.tag);
      visit(node.boundary_node);
    }
    if (!(usual & kAtReference)) {
      visit(node.reference);
      visit(node.reference_on);
    }
  }
};

}  // namespace pnpbs
