// SPDX-License-Identifier: BSD-3-Clause
// The part of space in which a rank lays first nodes on surfaces.
#pragma once

#include <cstdint>
#include <functional>

#include "base/types.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// Cells that cover the surfaces, the same on all ranks, and which of them are this rank's.
struct RankCells {
  const BackgroundTree<3>& tree;  // its leaves are the cells
  std::function<bool(std::int32_t cell)> owns;

  bool hold(const Point<3>& x) const { return owns(tree.leaf_at(x)); }
  bool meet(const Box<3>& box) const {
    bool met = false;
    tree.for_leaves_in(
        box, [&](std::int32_t) { return !met; },
        [&](std::int32_t cell) { met = met || owns(cell); });
    return met;
  }
};

}  // namespace pnpbs
