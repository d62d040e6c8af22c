// SPDX-License-Identifier: BSD-3-Clause
// The graph that the partition cuts: the cells that have work, linked where they touch.
#pragma once

#include <cstdint>
#include <vector>

#include "partition/partition_cells.hpp"

namespace pnpbs {

// Compressed rows. METIS dislikes weights of 0 and empty graphs.
struct CellGraph {
  std::vector<std::int32_t> cell;  // of each vertex
  std::vector<std::int32_t> offset{0}, neighbour, weight, cut_weight;
};

// In the plane, cells that touch in a corner are linked as well, by the least weight. In a volume,
// where 20 of 26 neighbours would be of that kind, only cells with a common face are.
template <int Dim>
CellGraph cell_graph(const PartitionCells<Dim>& cells);

}  // namespace pnpbs
