// SPDX-License-Identifier: BSD-3-Clause
// What the pictures show.
#pragma once

#include <cstdint>
#include <vector>

namespace pnpbs::picture {

struct NodeSet {
  std::vector<double> xy;               // [nodes][2]
  std::vector<std::int64_t> ids;        // [nodes]
  std::vector<std::int32_t> tags;       // [nodes], 0: inner node
  std::vector<double> spacing;          // [nodes], d at the node
  std::vector<std::int64_t> triangles;  // [triangles][3]; empty if there are none
  std::vector<double> outline;          // [segments][2][2], curves of the domain

  std::size_t size() const { return ids.size(); }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

}  // namespace pnpbs::picture
