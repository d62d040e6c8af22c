// SPDX-License-Identifier: BSD-3-Clause
// The edges of a planar graph as chains, each from one break to the next.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs {

struct Chain {
  std::vector<std::int32_t> vertices;  // one more than edges; closed ones end where they begin
  std::vector<std::int32_t> edges;
  bool closed = false;  // no break on it
};

// Every edge is in one chain. `is_break` has an entry for each vertex; those that do not end two
// edges must be breaks. The chains, their begins and directions depend on the order of the edges
// alone.
std::vector<Chain> chains_between(const std::vector<char>& is_break,
                                  const std::vector<std::array<std::int32_t, 2>>& ends);

}  // namespace pnpbs
