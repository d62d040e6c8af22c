// SPDX-License-Identifier: BSD-3-Clause
#include "level/node_digest.hpp"

#include <algorithm>

namespace pnpbs {

std::uint64_t node_digest(const Level<3>& level) {
  const std::uint64_t sum = sum_of_node_hashes(
      level, [&](std::int64_t i, std::uint64_t h) { return mixed_with(h, level.nodes.d(i)); });
  return std::max<std::uint64_t>(sum, 1);
}

}  // namespace pnpbs
