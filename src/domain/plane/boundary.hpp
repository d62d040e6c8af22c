// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a plane domain: nodes laid on the curves, and the straight edges between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "base/warning.hpp"
#include "domain/curve_steps.hpp"
#include "domain/plane/plane_domain.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Nodes: corners first, in the domain's order, then curve by curve, then fixed nodes. Edges lie
// between consecutive nodes of a curve.
struct Boundary : BoundaryMesh<2> {
  std::int64_t first_fixed;  // index of the first fixed node that is on no curve
  std::vector<Warning> warnings;
};

// Lays nodes at equal steps of the integral of ds/d between corners,
// n = max(1, round(integral)) edges each (3 at least on a closed curve with one corner); then
// makes sure that the edges divide the plane as the curves do: edges whose chord cuts another one,
// or passes a node on the wrong side, are halved on their curve until none does, with a warning
// that names the curve. The paper's repeated bisection
// (section 2.1) has the same result. d is asked on the curves only. Warns where d is larger than
// the feature (edges shorter than half of d, nodes closer than 0.1 d to another edge across the
// inside: the worst few are named, with the number of them), and where a fixed node is closer than
// 0.4 d to an edge or to another fixed node.
// Throws Error(ErrorKind::spacing) if there would be more than `max_nodes`.
Boundary discretize_boundary(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing,
                             std::int64_t max_nodes = kMaxNodesOnCurves);

// How large the bubble of each boundary node may be. Where a boundary is far finer than d, as a
// circle of thousands of segments, bubbles of diameter d would hold thousands of each other: there
// they are no larger than some edges of their own.
std::vector<double> bubbles_on_boundary(const Boundary& boundary);

}  // namespace pnpbs
