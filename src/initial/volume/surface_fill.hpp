// SPDX-License-Identifier: BSD-3-Clause
// Places initial nodes on the patches of surfaces, as section 2.1 of the paper does in the plane. A
// flat patch with nearly constant d gets a hexagonal lattice. Other patches are divided into pieces
// about as wide as d; the number of nodes that d requires is summed over the pieces in Morton
// order, and a node is placed where the sum passes an integer. Each rank makes only the pieces and
// lattice nodes in its own cells, and sums over cells give it the number of nodes before them.
#pragma once

#include <vector>

#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/surface.hpp"
#include "initial/volume/surface_pieces.hpp"

namespace pnpbs {

// Returns the nodes in the cells of this rank, patch by patch. They keep a distance from features,
// which have nodes of their own. A closed patch without features has at least four nodes. The union
// over all ranks depends only on the surface and on d.
// Collective. Throws Error(ErrorKind::spacing) or Error(ErrorKind::memory) on all ranks if there
// would be more nodes or pieces than the limit allows.
std::vector<SurfacePoint> surface_fill(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells);

}  // namespace pnpbs
