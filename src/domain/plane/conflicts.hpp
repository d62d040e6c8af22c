// SPDX-License-Identifier: BSD-3-Clause
// What must not meet in a domain of the plane, but does.
#pragma once

#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// The graph of a domain, its points (vertices, then region points), and what their sweep has found.
struct SweptGraph {
  const std::vector<CurveSource>& sources;
  const std::vector<RegionPoint<2>>& region_points;
  const std::vector<FixedNode<2>>& fixed_nodes;
  const DomainGraph& graph;
  const std::vector<Point<2>>& points;
  const SweepResult& sweep;
};

// Throws Error(ErrorKind::domain) if edges cross, overlap or touch, with up to twenty of the
// places.
void reject_conflicts(const SweptGraph& swept);

}  // namespace pnpbs
