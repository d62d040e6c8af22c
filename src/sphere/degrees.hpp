// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

inline constexpr double kDegree = std::numbers::pi / 180;  // radians

// Of a place on a sphere about the origin; 0 and 0 of the origin.
inline double longitude_of(const Point<3>& x) { return std::atan2(x[1], x[0]) / kDegree; }
inline double latitude_of(const Point<3>& x) {
  return std::atan2(x[2], std::hypot(x[0], x[1])) / kDegree;
}
inline Point<2> degrees_of(const Point<3>& x) { return {longitude_of(x), latitude_of(x)}; }

// Of length 1, as rounding leaves it: the poles are not exact.
inline Point<3> direction_at(const Point<2>& degrees) {
  const double lon = kDegree * degrees[0], lat = kDegree * degrees[1];
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// Along a parallel, of length 1; at the poles as on longitude 0.
inline Point<3> east_at(const Point<3>& x) {
  const double across = std::hypot(x[0], x[1]);
  return across > 0 ? Point<3>{-x[1] / across, x[0] / across, 0} : Point<3>{0, 1, 0};
}

}  // namespace pnpbs
