// SPDX-License-Identifier: BSD-3-Clause
// A background tree for the facets alone: its cells hold few of them each, whatever d is.
#pragma once

#include "geometry/facet_index.hpp"

namespace pnpbs {

// The mesh must outlive the index.
template <int Dim>
FacetIndex<Dim> index_facets(const BoundaryMesh<Dim>& mesh, const Box<Dim>& bounds);

extern template FacetIndex<2> index_facets(const BoundaryMesh<2>&, const Box<2>&);
extern template FacetIndex<3> index_facets(const BoundaryMesh<3>&, const Box<3>&);

}  // namespace pnpbs
