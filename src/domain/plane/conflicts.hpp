// SPDX-License-Identifier: BSD-3-Clause
// Detects curves and points of a plane domain that cross, overlap or touch.
#pragma once

#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// A domain's graph, its points (vertices, then region points), and the result of the plane sweep
// over them.
struct SweptGraph {
  const std::vector<CurveSource>& sources;
  const std::vector<RegionPoint<2>>& region_points;
  const std::vector<FixedNode<2>>& fixed_nodes;
  const DomainGraph& graph;
  const std::vector<Point<2>>& points;
  const SweepResult& sweep;
};

// Throws Error(ErrorKind::domain) if edges cross, overlap or touch. The message lists up to twenty
// locations.
void reject_conflicts(const SweptGraph& swept);

}  // namespace pnpbs
