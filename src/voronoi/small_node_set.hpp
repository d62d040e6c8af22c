// SPDX-License-Identifier: BSD-3-Clause
// Linear searches in sets of so few nodes that branches would cost more than reading all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pnpbs {

// Returns the last index of the node, or -1.
inline std::int32_t index_among(std::span<const std::int32_t> nodes, std::int32_t node) {
  std::int32_t place = -1;
  const std::int32_t count = static_cast<std::int32_t>(nodes.size());
  for (std::int32_t k = 0; k < count; ++k)
    place = nodes[static_cast<std::size_t>(k)] == node ? k : place;
  return place;
}

inline bool has(std::span<const std::int32_t> nodes, std::int32_t node) {
  unsigned found = 0;
  for (const std::int32_t other : nodes) found |= static_cast<unsigned>(other == node);
  return found != 0;
}

}  // namespace pnpbs
