// SPDX-License-Identifier: BSD-3-Clause
// Decomposes the edges of a planar graph into chains between break vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs {

struct Chain {
  std::vector<std::int32_t> vertices;  // One more than edges; equal ends if closed.
  std::vector<std::int32_t> edges;
  bool closed = false;  // The chain contains no break.
};

// Returns chains that contain every edge exactly once. `is_break` has one entry per vertex. A
// vertex whose number of edges is not two must be a break. The result depends on the order of the
// edges only.
std::vector<Chain> chains_between(const std::vector<char>& is_break,
                                  const std::vector<std::array<std::int32_t, 2>>& ends);

}  // namespace pnpbs
