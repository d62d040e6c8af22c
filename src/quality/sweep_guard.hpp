// SPDX-License-Identifier: BSD-3-Clause
// The guard of the finishing sweeps, which rejects moves that make bad triangles worse. A bound
// without square roots accepts most nodes, a block at a time; only the remaining nodes are checked
// one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/delaunay_stars.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

// Sets allowed(i) for the nodes of block b: true if no triangle of node i gets worse that is or
// becomes bad when the node moves to its proposed position. A triangle is bad if its quality is
// below `bad_below`; `bound` must be QualityBound(bad_below). The entry is false for nodes that do
// not move and for nodes with an open star.
void guard_block(const Nodes<2>& nodes, const DelaunayStars& stars, double bad_below,
                 const QualityBound& bound, const Field<2>& proposed, View<char>& allowed,
                 std::int64_t b);

// Returns the nodes, in memory order, that may have a triangle with a quality below `quality`. The
// test is conservative: the result contains all such nodes, and a few others.
std::vector<std::int32_t> nodes_with_doubtful_triangles(const Nodes<2>& nodes,
                                                        const DelaunayStars& stars, double quality);

}  // namespace pnpbs
