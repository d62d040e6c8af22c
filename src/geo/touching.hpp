// SPDX-License-Identifier: BSD-3-Clause
// Common edges of neighbouring features that have different vertices. If a vertex of one lies on a
// segment of the other, the segment is split there. This happens in the coordinates of the file,
// where the vertex is on the segment. After projection the segment is curved, and there would be a
// gap.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "geo/outlines.hpp"
#include "geo/projection.hpp"

namespace pnpbs::geo {

// Distance at which a vertex is nearly on a segment. If the layer extends over 10 degrees, it is a
// metre, which covers vertices with few digits or drawn by hand. [extent of the layer]
inline constexpr double nearly_on_it = 1e-6;

// A vertex that is nearly on a segment of another feature.
struct NearMiss {
  std::int64_t place;
  std::int64_t feature, other;  // feature: of the vertex; other: of the segment
};

// Splits the segments of routes at vertices that lie on them, except segments that two routes
// share. Points must be canonical, see Projection::canonical(). Returns the first near miss of the
// other vertices, if there is one.
std::optional<NearMiss> split_where_touched(std::vector<Route>& routes,
                                            const std::vector<Point<2>>& points,
                                            const Projection& projection);

}  // namespace pnpbs::geo
