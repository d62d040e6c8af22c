// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a plane domain that pictures show.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs::picture {

// Nodes and triangles of a plane domain, with the curves of the domain.
struct NodeSet {
  std::vector<double> xy;                              // [nodes][2]
  std::vector<std::int64_t> ids;                       // [nodes]
  std::vector<std::int32_t> tags;                      // [nodes], 0: inner node
  std::vector<double> spacing;                         // [nodes], d at the node
  std::vector<std::array<std::int64_t, 3>> triangles;  // corners, as indices of nodes; may be empty
  std::vector<double> outline;  // [segments][2][2], coordinates of the curves of the domain
  std::vector<bool> open;       // [segments], whether it is part of an open boundary

  std::size_t size() const { return ids.size(); }
};

}  // namespace pnpbs::picture
