// SPDX-License-Identifier: BSD-3-Clause
// Initial nodes on the patches of surfaces (section 2.1 of the paper, for surfaces). A flat patch
// on which d is nearly constant has a hexagonal lattice. On others, pieces of about d are taken in
// Morton order, and a node comes wherever the sum of the nodes that d asks for passes a whole
// number: the density is right, and bubbles settle the distances. Each rank makes the pieces and
// the lattice in its own cells only; sums over cells tell it what comes before.
#pragma once

#include <vector>

#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/surface.hpp"
#include "initial/volume/surface_pieces.hpp"

namespace pnpbs {

// The nodes in cells of this rank, patch by patch. They keep off features, which have their own. A
// closed patch without features has four nodes at least. What all ranks have together depends on
// the surface and d alone. Throws Error(ErrorKind::spacing) if there would be more than the limit
// allows. Collective.
std::vector<SurfacePoint> surface_fill(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells);

}  // namespace pnpbs
