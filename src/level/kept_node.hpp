// SPDX-License-Identifier: BSD-3-Clause
// The conversion of a node of a level into an incoming node of the same or another level.
#pragma once

#include <cstdint>

#include "base/nodes.hpp"
#include "initial/incoming_nodes.hpp"

namespace pnpbs {

inline IncomingNode<2> kept_node(const Nodes<2>& nodes, std::int64_t i) {
  return {nodes.position(i), nodes.id(i), nodes.moves(i), -1, nodes.d(i)};
}

inline IncomingNode<3> kept_node(const Nodes<3>& nodes, std::int64_t i) {
  return {nodes.position(i), nodes.id(i), nodes.carrier(i), nodes.boundary_node(i),
          nodes.tag(i),      -1,          nodes.d(i)};
}

}  // namespace pnpbs
