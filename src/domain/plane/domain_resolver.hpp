// SPDX-License-Identifier: BSD-3-Clause
// From what the user gave to what the nodes are laid on.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Joins the sources into one graph, checks it, finds the inside and cuts the curves at their
// corners. Adds samples to smooth sources where they are met or come close to others. Throws
// Error(ErrorKind::domain).
ResolvedDomain resolve_domain(std::vector<CurveSource>& sources,
                              const std::vector<RegionPoint<2>>& region_points,
                              const std::vector<FixedNode<2>>& fixed_nodes);

}  // namespace pnpbs
