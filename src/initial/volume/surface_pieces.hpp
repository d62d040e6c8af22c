// SPDX-License-Identifier: BSD-3-Clause
// Divides the facets of surfaces into pieces about as wide as d, and evaluates d on each.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/types.hpp"
#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/surface.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// The cells in which a rank places initial nodes on surfaces. The cells cover the surfaces and are
// the same on all ranks; each belongs to one rank.
struct RankCells {
  const BackgroundTree<3>& tree;  // its leaves are the cells
  std::function<bool(std::int32_t cell)> owns;

  // Returns true if x lies in a cell of this rank.
  bool hold(const Point<3>& x) const { return owns(tree.leaf_at(x)); }
  // Returns true if the box meets a cell of this rank.
  bool meet(const Box<3>& box) const {
    bool met = false;
    tree.for_leaves_in(
        box, [&](std::int32_t) { return !met; },
        [&](std::int32_t cell) { met = met || owns(cell); });
    return met;
  }
};

// A part of a facet that has room for less than one node.
struct SurfacePiece {
  SurfacePoint centre;
  std::int32_t cell;
  double area;
  double d;  // at the centre
};

// The pieces of a patch on this rank.
struct PatchPieces {
  bool met = false;                  // true if a facet of the patch meets cells of this rank
  double area = 0;                   // area of the whole patch
  std::vector<SurfacePiece> pieces;  // those with centres in cells of this rank
};

// Returns the pieces of each patch in Morton order of their centres. Each piece is on exactly one
// rank, and the pieces do not depend on the distribution of cells. Evaluates d at the centres, in
// batches. In a closed patch without features d is reduced until there is room for four nodes, the
// fewest of a closed triangulation.
// Collective. Throws Error(ErrorKind::spacing) or Error(ErrorKind::memory) on all ranks if there
// would be more nodes or pieces than the limit allows.
std::vector<PatchPieces> cut_to_pieces(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells);

}  // namespace pnpbs
