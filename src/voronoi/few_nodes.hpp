// SPDX-License-Identifier: BSD-3-Clause
// Searches among so few nodes that a branch for each would cost more than to look at all of them.
#pragma once

#include <cstdint>
#include <span>

namespace pnpbs {

inline bool has(std::span<const std::int32_t> nodes, std::int32_t node) {
  unsigned found = 0;
  for (const std::int32_t other : nodes) found |= static_cast<unsigned>(other == node);
  return found != 0;
}

}  // namespace pnpbs
