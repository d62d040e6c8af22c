// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that are finer than nodes can follow, as coastlines are: vertices are left out where
// pieces are shorter than d, and closed curves that are too small for nodes as a whole.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Straight segments of graphs and polylines; arcs and general curves stay. No vertex that stays,
// fixed node or region point comes to another side of a curve. Vertices stay where curves meet or
// end, where tags change or a vertex has its own, at fixed nodes, and beside pieces as long as d. A
// curve with one of these, or with another curve around which it goes that stays, is not left out,
// nor is the one of the largest extent; region points within those left out go with them. Throws
// Error as the evaluator does, and for points that must not coincide.
LeftOut simplify(std::vector<CurveSource>& sources, std::vector<RegionPoint<2>>& region_points,
                 const std::vector<FixedNode<2>>& fixed_nodes,
                 const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule);

}  // namespace pnpbs
