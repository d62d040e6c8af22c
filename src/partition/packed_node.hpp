// SPDX-License-Identifier: BSD-3-Clause
// A node as ranks send it to each other: a plain record of all its fields.
#pragma once

#include <cstdint>
#include <functional>

#include "base/nodes.hpp"
#include "base/periodic_cell.hpp"

namespace pnpbs {

template <int Dim>
using BoundarySeenFrom =
    std::function<std::int32_t(const Image<Dim>& image, Carrier carrier, std::int32_t on)>;

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

}  // namespace pnpbs
