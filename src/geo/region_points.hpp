// SPDX-License-Identifier: BSD-3-Clause
// Regions of a domain that are given by polygons: a point in each part of a polygon, as a domain
// takes regions.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "base/message_text.hpp"
#include "base/types.hpp"
#include "geo/outlines.hpp"

namespace pnpbs::geo {

// A point in a region, whose elements get the tag.
struct RegionPoint {
  Point<2> point;
  std::int32_t tag;
};

// A narrow strip between polygons of two features.
struct Gap {
  std::int64_t feature, other;
  Point<2> point;
  double width;
};

// The points in regions, and the narrowest of the gaps between polygons.
struct RegionPoints {
  std::vector<RegionPoint> points;
  std::optional<Gap> gap;
};

// Returns a point on either side of each curve that lies in a polygon, so that all parts into which
// curves divide the polygons have a point. `tags` has the tag of each feature with polygons; those
// with tag 0 get no point. Coordinates are in the plane. Throws Error with the location, described
// by `where`, if polygons of two features overlap there.
RegionPoints region_points_of(const std::vector<Curve>& curves, const std::vector<Route>& routes,
                              const std::vector<Point<2>>& points,
                              const std::map<std::int64_t, std::int32_t>& tags,
                              const std::function<MessageText(const Point<2>&)>& where);

}  // namespace pnpbs::geo
