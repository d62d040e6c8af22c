// SPDX-License-Identifier: BSD-3-Clause
// Turns what the user gave for a plane domain into the curves and corners on which nodes are
// placed.
#pragma once

#include <optional>
#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Joins the sources into one graph, checks it, finds the inside and cuts the curves at their
// corners. Adds samples to smooth sources where other points lie on them or where they come close
// to other curves. If `fragment` is set, curves are split where they meet, and it decides the tags
// of regions in several solids (CurveSolids). With `split` they are split only. Otherwise they may
// touch: in points, and along common edges if no solids overlap. Throws Error(ErrorKind::domain).
ResolvedDomain resolve_domain(std::vector<CurveSource>& sources,
                              const std::vector<RegionPoint<2>>& region_points,
                              const std::vector<FixedNode<2>>& fixed_nodes,
                              std::optional<OverlapRule> fragment, bool split = false);

}  // namespace pnpbs
