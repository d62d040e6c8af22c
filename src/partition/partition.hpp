// SPDX-License-Identifier: BSD-3-Clause
// Domain decomposition: cuts the graph of the partition cells into one part per rank, with METIS.
#pragma once

#include <cstdint>
#include <vector>

#include "partition/partition_cells.hpp"

namespace pnpbs {

// Rank that owns each cell: equal shares of the work along the Morton order.
std::vector<std::int32_t> cut_morton_order(const std::vector<std::int64_t>& work, int ranks);

// The same by METIS, which cuts few interactions; cells without work go as the Morton order has
// them. Parts may be empty (more ranks than cells with work). Where METIS refuses or leaves the
// work badly spread, the Morton order is cut instead. The result depends on the seed; the nodes do
// not.
template <int Dim>
std::vector<std::int32_t> cut_by_metis(const PartitionCells<Dim>& cells, int ranks,
                                       std::int64_t seed);

// The work in a part that a rank has now.
struct KeptWork {
  std::int64_t work;
  std::int32_t part, rank;
};

// Gives the parts other numbers so that little work changes its rank. kept: where there is any, in
// any order.
std::vector<std::int32_t> relabelled(std::vector<std::int32_t> owner, std::vector<KeptWork> kept,
                                     int ranks);

// Largest over mean work of the parts.
double imbalance(const std::vector<std::int32_t>& owner, const std::vector<std::int64_t>& work,
                 int ranks);

// The graph that the partition cuts: the cells that have work, linked where they touch. Compressed
// rows. METIS dislikes weights of 0 and empty graphs.
struct CellGraph {
  std::vector<std::int32_t> cell;  // of each vertex
  std::vector<std::int32_t> offset{0}, neighbour, weight, cut_weight;
};

// In the plane, cells that touch in a corner are linked as well, by the least weight. In a volume,
// where 20 of 26 neighbours would be of that kind, only cells with a common face are.
template <int Dim>
CellGraph cell_graph(const PartitionCells<Dim>& cells);

}  // namespace pnpbs
