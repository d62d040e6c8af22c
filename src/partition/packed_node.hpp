// SPDX-License-Identifier: BSD-3-Clause
// A node on its way to another rank.
#pragma once

#include <cstdint>

#include "base/nodes.hpp"

namespace pnpbs {

struct PackedNode {
  std::int64_t id;
  double x[2], v[2], anchor[2], d;
  std::int32_t tag, boundary_node;
};

inline PackedNode packed(const Nodes<2>& nodes, std::int64_t i) {
  return {nodes.id(i),
          {nodes.x[0](i), nodes.x[1](i)},
          {nodes.v[0](i), nodes.v[1](i)},
          {nodes.anchor[0](i), nodes.anchor[1](i)},
          nodes.d(i),
          nodes.tag(i),
          nodes.boundary_node(i)};
}

inline void append(Nodes<2>& nodes, const PackedNode& packed, bool owned) {
  nodes.append({packed.x[0], packed.x[1]}, packed.d, packed.id, packed.tag, packed.boundary_node);
  const std::int64_t i = nodes.count - 1;
  for (int k = 0; k < 2; ++k) {
    nodes.v[k](i) = packed.v[k];
    nodes.anchor[k](i) = packed.anchor[k];
  }
  nodes.owned(i) = owned;
}

}  // namespace pnpbs
