// SPDX-License-Identifier: BSD-3-Clause
// Facets of a distributed mesh: the sides of elements that lie on the boundary or on an inner curve
// or surface.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/elements_at_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Returns the facets of the elements that this rank owns. `numbers` maps the index of a node in the
// results to its number. On a surface mesh the facets are the edges with a single triangle, and
// they have its tag. Collective.
template <std::size_t Corners, int Dim>
std::vector<MeshFacet<Corners>> facets_of_owned_elements(const Results<Dim>& results,
                                                         const std::vector<std::int64_t>& numbers,
                                                         const RankRanges& nodes,
                                                         const RankRanges& elements,
                                                         const ElementsAtNodes<Corners>& at_nodes);

// Instances: triangles of the plane, triangles of surface meshes, tetrahedra.
#define PNPBS_FACETS_OF(Corners, Dim)                                                              \
  std::vector<MeshFacet<Corners>> facets_of_owned_elements<Corners, Dim>(                          \
      const Results<Dim>&, const std::vector<std::int64_t>&, const RankRanges&, const RankRanges&, \
      const ElementsAtNodes<Corners>&)
extern template PNPBS_FACETS_OF(3, 2);
extern template PNPBS_FACETS_OF(3, 3);
extern template PNPBS_FACETS_OF(4, 3);

}  // namespace pnpbs
