// SPDX-License-Identifier: BSD-3-Clause
// Simplifies boundaries that are finer than nodes can follow, such as coastlines. Removes vertices
// beside segments shorter than d, and closed curves that are too small for nodes.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Simplifies graphs and polylines; arcs and general curves stay. No remaining vertex, fixed node or
// region point changes its side of a curve.
// A vertex stays at meeting points and ends of curves, where tags change, if it has a tag of its
// own, at fixed nodes, and between segments that are both as long as d. A closed curve stays if one
// of its vertices must stay or if it encloses something that stays; the curve of the largest extent
// stays, too. Region points inside removed curves are removed.
// Throws Error as the evaluator does, and Error(ErrorKind::domain) for points that must not
// coincide.
LeftOut simplify(std::vector<CurveSource>& sources, std::vector<RegionPoint<2>>& region_points,
                 const std::vector<FixedNode<2>>& fixed_nodes,
                 const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule);

}  // namespace pnpbs
