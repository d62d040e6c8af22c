// SPDX-License-Identifier: BSD-3-Clause
// The guard of the sweeps. Most nodes pass it by a bound without square roots, a block of them at a
// time; the others are looked at one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/delaunay_stars.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

// Which nodes of block b may go to their proposed places: none of their triangles gets worse that
// is or becomes bad, i.e. below the quality bad_below, for which `bound` is. 0 for nodes that do
// not move at all.
void guard_block(const Nodes<2>& nodes, const DelaunayStars& stars, double bad_below,
                 const QualityBound& bound, const Field<2>& proposed, View<char>& allowed,
                 std::int64_t b);

// The nodes, in the order of memory, that may have a triangle below this quality.
std::vector<std::int32_t> nodes_with_doubtful_triangles(const Nodes<2>& nodes,
                                                        const DelaunayStars& stars, double quality);

}  // namespace pnpbs
