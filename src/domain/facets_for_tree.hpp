// SPDX-License-Identifier: BSD-3-Clause
// The facets by which a background tree distinguishes inside from outside. In the plane they are
// the edges between boundary nodes placed for a spacing, in space the surfaces as given.
#pragma once

#include "domain/domain.hpp"
#include "domain/plane/boundary.hpp"

namespace pnpbs {

inline BoundaryMesh<2> facets_for_tree(const PlaneDomain& domain, const SpacingEvaluator<2>& d,
                                       std::int64_t max_nodes) {
  return discretize_boundary(domain, d, max_nodes);
}
inline BoundaryMesh<3> facets_for_tree(const VolumeDomain& domain, const SpacingEvaluator<3>&,
                                       std::int64_t) {
  return domain.mesh();
}

}  // namespace pnpbs
