// SPDX-License-Identifier: BSD-3-Clause
// Finds where curves of a plane domain cross, so that they can be split there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// Returns the pairs of edges without a common vertex that meet in one point, in order. `points`
// begins with the positions of the vertices. Decisions are exact. Takes O(n log n) time if edges
// have few neighbours.
std::vector<std::array<std::int32_t, 2>> crossing_edges(const DomainGraph& graph,
                                                        const std::vector<Point<2>>& points);

// Returns the point in which two edges of crossing_edges() meet. On smooth curves it is the point
// where the curves meet, not their chords.
Point<2> meeting_point(const std::vector<CurveSource>& sources, const DomainGraph& graph,
                       const std::vector<Point<2>>& points, std::int32_t edge, std::int32_t other);

}  // namespace pnpbs
