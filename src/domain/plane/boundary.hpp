// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a plane domain: nodes placed on the curves, and the straight edges between them.
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

// Nodes and edges of the boundary. Nodes are corners first, in the domain's order, then those of
// each curve, then fixed nodes. Edges connect consecutive nodes of a curve.
struct Boundary : BoundaryMesh<2> {
  std::int64_t first_fixed;       // index of the first fixed node that is on no curve
  std::vector<Point<2>> middles;  // of each edge, the point of its curve between the two nodes
  std::vector<Warning> warnings;
};

// Places nodes on each curve between corners at equal steps of the integral of ds/d (see
// equal_step_stations). The paper's repeated bisection (section 2.1) has the same result.
// The edges must divide the plane as the curves do. Edges whose chord crosses another edge, or
// passes a node on the wrong side, are therefore halved on their curve until none does; a warning
// names the curve.
// Warns of the worst edges shorter than d/2, of nodes closer than 0.1 d to another edge across the
// inside, and of fixed nodes closer than 0.4 d to an edge or to another fixed node.
// Evaluates d on the curves and at fixed nodes only. Throws Error(ErrorKind::spacing) if there
// would be more than `max_nodes` nodes or far too many edges per d, and Error(ErrorKind::domain) if
// halving does not separate the curves.
Boundary discretize_boundary(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing,
                             std::int64_t max_nodes = kMaxNodesOnCurves);

// Returns an upper bound of the bubble diameter of each boundary node: kBubbleOfEdges times its
// longest edge, and infinity for fixed nodes. Without it, bubbles on a boundary far finer than d,
// such as a circle of thousands of segments, would each overlap thousands of others.
std::vector<double> bubbles_on_boundary(const Boundary& boundary);

}  // namespace pnpbs
