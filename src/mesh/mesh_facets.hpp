// SPDX-License-Identifier: BSD-3-Clause
// Which sides of elements are parts of the boundary, or of an inner curve or surface.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/elements_at_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

// The facets of the elements that this rank owns. numbers: of the nodes, by their places. On
// surfaces alone they are the edges of only one triangle, with its tag. Collective.
template <std::size_t Corners, int Dim>
std::vector<MeshFacet<Corners>> facets_of_owned_elements(const Results<Dim>& results,
                                                         const std::vector<std::int64_t>& numbers,
                                                         const RankRanges& nodes,
                                                         const RankRanges& elements,
                                                         const ElementsAtNodes<Corners>& at_nodes);

// Triangles of the plane and of surfaces alone, and tetrahedra.
#define PNPBS_FACETS_OF(Corners, Dim)                                                              \
  std::vector<MeshFacet<Corners>> facets_of_owned_elements<Corners, Dim>(                          \
      const Results<Dim>&, const std::vector<std::int64_t>&, const RankRanges&, const RankRanges&, \
      const ElementsAtNodes<Corners>&)
extern template PNPBS_FACETS_OF(3, 2);
extern template PNPBS_FACETS_OF(3, 3);
extern template PNPBS_FACETS_OF(4, 3);

}  // namespace pnpbs
