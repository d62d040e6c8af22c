// SPDX-License-Identifier: BSD-3-Clause
// Initial nodes on the patches of surfaces (section 2.1 of the paper, for surfaces). A flat patch
// on which d is nearly constant has a hexagonal lattice. On others, pieces of about d are taken in
// Morton order, and a node comes wherever the sum of the nodes that d asks for passes a whole
// number: the density is right, and bubbles settle the distances.
#pragma once

#include <vector>

#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/surface.hpp"

namespace pnpbs {

// Patch by patch. Nodes keep off features, which have their own. A closed patch without features
// has four nodes at least. Depends on the surface and d alone. Throws Error(ErrorKind::spacing) if
// there would be more than the limit allows.
std::vector<SurfacePoint> surface_fill(const Surface& surface, const SpacingEvaluator<3>& spacing,
                                       const NodeLimit& limit);

}  // namespace pnpbs
