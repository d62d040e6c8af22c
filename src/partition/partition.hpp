// SPDX-License-Identifier: BSD-3-Clause
// Domain decomposition: cuts the graph of the partition cells into one part per rank with METIS.
#pragma once

#include <cstdint>
#include <vector>

#include "partition/partition_cells.hpp"

namespace pnpbs {

// Returns the owner of each cell: equal shares of the work along the Morton order.
std::vector<std::int32_t> cut_morton_order(const std::vector<std::int64_t>& work, int ranks);

// Returns the owner of each cell by METIS, which cuts few interactions, and balances the work and,
// if cells have any, the rare work. Cells without work keep their owner of the Morton order. Parts
// may be empty if there are more ranks than cells with work. Returns the Morton order's partition
// if METIS fails or balances much worse. The partition depends on `seed`; the nodes do not.
template <int Dim>
std::vector<std::int32_t> cut_by_metis(const PartitionCells<Dim>& cells, int ranks,
                                       std::int64_t seed);

// Work of a new part that lies on a rank before the repartition.
struct KeptWork {
  std::int64_t work;
  std::int32_t part, rank;
};

// Renumbers the parts so that little work changes its rank. `kept` has the nonzero entries, in any
// order.
std::vector<std::int32_t> renumbered_parts(std::vector<std::int32_t> owner,
                                           std::vector<KeptWork> kept, int ranks);

// Returns the imbalance: the largest over the mean work of the parts.
double imbalance(const std::vector<std::int32_t>& owner, const std::vector<std::int64_t>& work,
                 int ranks);

// Graph for METIS in compressed rows: a vertex for each cell with work and an edge for each pair of
// touching cells. All weights are positive, as METIS requires, except those of rare work.
struct CellGraph {
  std::vector<std::int32_t> cell;  // cell of each vertex
  std::vector<std::int32_t> offset{0}, neighbour, cut_weight;
  std::vector<std::int32_t> weight;  // one for each vertex, or two if cells have rare work
};

// Returns the graph of `cells`. In the plane, cells that share only a corner are linked with the
// smallest weight. In space only cells with a common face are linked, since 20 of 26 neighbours
// share less.
template <int Dim>
CellGraph cell_graph(const PartitionCells<Dim>& cells);

}  // namespace pnpbs
