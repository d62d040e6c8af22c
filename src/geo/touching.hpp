// SPDX-License-Identifier: BSD-3-Clause
// Neighbours need not have the same vertices along an edge in common: where one has a vertex on a
// segment of the other, the segment gets it, too. In the coordinates of the file, where it lies on
// it; projected, the segment is another curve, and there would be a gap.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "geo/outlines.hpp"
#include "geo/projection.hpp"

namespace pnpbs::geo {

// A vertex that all but lies on a segment of another feature.
struct NearMiss {
  std::int64_t place;
  std::int64_t feature, other;  // whose vertex, whose segment
};

// Splits segments that no other route has where places of routes lie on them. The first near miss
// among the others, if there is one. The points are canonical ones of the projection's data.
std::optional<NearMiss> split_where_touched(std::vector<Route>& routes,
                                            const std::vector<Point<2>>& points,
                                            const Projection& projection);

}  // namespace pnpbs::geo
