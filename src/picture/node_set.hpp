// SPDX-License-Identifier: BSD-3-Clause
// What the pictures show.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs::picture {

struct NodeSet {
  std::vector<double> xy;                              // [nodes][2]
  std::vector<std::int64_t> ids;                       // [nodes]
  std::vector<std::int32_t> tags;                      // [nodes], 0: inner node
  std::vector<double> spacing;                         // [nodes], d at the node
  std::vector<std::array<std::int64_t, 3>> triangles;  // corners; empty if there are none
  std::vector<double> outline;                         // [segments][2][2], curves of the domain

  std::size_t size() const { return ids.size(); }
};

}  // namespace pnpbs::picture
