// SPDX-License-Identifier: BSD-3-Clause
// Sums along the cells of the partition, of which each rank counts some: the cells are cut into one
// block of equal length per rank, and who has the block of a cell is told its sum and asked for the
// sum before it. What a rank sends grows with the cells it counts, not with all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

struct CellSum {
  std::int64_t cell, sum;
};

// own: by increasing cell, 0 to cells - 1; several ranks may count in the same one. Returns for
// each of these the sum over the cells before it, of all ranks, from `start` on; moves `start` on
// by the sum over all. All of that modulo 2^64. Collective.
std::vector<std::int64_t> sums_before(const Communicator& comm, std::int64_t cells,
                                      const std::vector<CellSum>& own, std::int64_t& start);

}  // namespace pnpbs
