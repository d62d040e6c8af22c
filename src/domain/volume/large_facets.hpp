// SPDX-License-Identifier: BSD-3-Clause
// Whether the largest pieces of a surface alone would have too many nodes: one vertex far away,
// say.
#pragma once

#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// From few places on each and the largest d there, so that it is far less work than to lay nodes,
// and they are rather fewer than would be laid. Throws Error(ErrorKind::spacing) or ::memory, with
// the longest of the edges.
void require_few_on_large_facets(const BoundaryMesh<3>& mesh, const Features& features,
                                 const SpacingEvaluator<3>& spacing, const NodeLimit& limit);

}  // namespace pnpbs
