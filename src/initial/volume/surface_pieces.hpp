// SPDX-License-Identifier: BSD-3-Clause
// Facets cut into pieces about as wide as d, so that d is known all over a surface.
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

// The part of space in which a rank lays first nodes on surfaces: cells that cover the surfaces,
// the same on all ranks, and which of them are this rank's.
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

struct SurfacePiece {
  SurfacePoint centre;
  std::int32_t cell;
  double area;
  double d;  // at the centre
};

struct PatchPieces {
  bool met = false;                  // has it a facet that meets cells of this rank?
  double area = 0;                   // of the whole patch
  std::vector<SurfacePiece> pieces;  // those with their centres in cells of this rank
};

// Of each patch, in the Morton order of their centres. All ranks together have every piece once,
// and what the pieces are does not depend on which cells are whose. d is asked at the centres, in
// batches. A piece has room for less than one node, and a patch that is closed for four at least:
// fewer make no closed triangulation, so there d counts for as much less. Throws
// Error(ErrorKind::spacing) if there would be more nodes than the limit allows. Collective.
std::vector<PatchPieces> cut_to_pieces(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells);

}  // namespace pnpbs
