// SPDX-License-Identifier: BSD-3-Clause
// Sums over the pieces of each patch of a surface, of which each rank has those in its cells. Each
// patch has a rank that sums over its cells: what a rank sends grows with the cells and patches
// that it has pieces of, not with the pieces.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/fixed_point.hpp"
#include "comm/communicator.hpp"

namespace pnpbs {

// Of the pieces of a patch in one cell, or in none: then the patch is asked about only.
struct PiecesInCell {
  static constexpr std::int32_t kNoCell = -1;

  std::int32_t patch, cell = kNoCell;
  FixedPointSum nodes{};  // that they have room for
  double min_d = std::numeric_limits<double>::infinity(), max_d = 0;
};

// What there is of the patch besides.
struct PatchSums {
  FixedPointSum nodes_before;  // in the cells before this one
  FixedPointSum nodes;         // in all of them
  double min_d = std::numeric_limits<double>::infinity(), max_d = 0;
};

// own: by increasing patch, 0 to patches - 1; no cell is another rank's as well. Returns the sums
// for each of these. They do not depend on which cells are whose. Collective.
std::vector<PatchSums> sums_over_patches(const Communicator& comm, std::int32_t patches,
                                         const std::vector<PiecesInCell>& own);

}  // namespace pnpbs
