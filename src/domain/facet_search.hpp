// SPDX-License-Identifier: BSD-3-Clause
// An index of facets with cells that hold few of them, whatever d is: for what is asked of the
// surfaces of a volume, which may be far finer than d, or coarser.
#pragma once

#include "domain/facet_index.hpp"

namespace pnpbs {

// The mesh must outlive it.
FacetIndex<3> index_facets(const BoundaryMesh<3>& mesh, const Box<3>& bounds);

}  // namespace pnpbs
