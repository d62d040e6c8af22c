// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the cells, edges and vertices of a grid over all ranks. Each is led by a node: those
// of the node with the least id come first. So they do not depend on the ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

// Of what a node leads: how many there are, or the number of the first one, from 0.
struct LedEntities {
  std::int64_t cells = 0, edges = 0, vertices = 0;

  LedEntities& operator+=(const LedEntities& other) {
    cells += other.cells;
    edges += other.edges;
    vertices += other.vertices;
    return *this;
  }
};

// The first numbers at each of this rank's nodes, and in `total` how many there are on all ranks.
// ids: increasing, and on no other rank. Collective.
std::vector<LedEntities> first_numbers(const Communicator& comm,
                                       const std::vector<std::int64_t>& ids,
                                       const std::vector<LedEntities>& counts, LedEntities& total);

}  // namespace pnpbs
