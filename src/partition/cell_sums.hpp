// SPDX-License-Identifier: BSD-3-Clause
// Prefix sums over the cells of the partition, where each rank contributes to some of the cells.
// The cells are divided into one block of equal length per rank. A rank sends its contributions to
// the ranks of the blocks and receives the prefix sums from them. Messages grow with the cells that
// a rank contributes to, not with the number of all cells.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

struct CellSum {
  std::int64_t cell, sum;
};

// Returns, for each entry of `own`, the sum over all cells before it and over all ranks, plus
// `start`. Then adds the sum over all cells to `start`. `own` is sorted by cell, from 0 to cells -
// 1; several ranks may contribute to a cell. Sums are modulo 2^64. Collective.
std::vector<std::int64_t> cell_prefix_sums(const Communicator& comm, std::int64_t cells,
                                           const std::vector<CellSum>& own, std::int64_t& start);

}  // namespace pnpbs
