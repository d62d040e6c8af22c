// SPDX-License-Identifier: BSD-3-Clause
// Longitudes and latitudes in degrees of points on a sphere about the origin, and the reverse.
#pragma once

#include <cmath>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

inline constexpr double kDegree = std::numbers::pi / 180;  // One degree in radians.

// Return the longitude and latitude of x in degrees; both are 0 if x is the origin.
inline double longitude_of(const Point<3>& x) { return std::atan2(x[1], x[0]) / kDegree; }
inline double latitude_of(const Point<3>& x) {
  return std::atan2(x[2], std::hypot(x[0], x[1])) / kDegree;
}
inline Point<2> degrees_of(const Point<3>& x) { return {longitude_of(x), latitude_of(x)}; }

// Returns the direction of a longitude and a latitude. Its length is 1 and the poles are exact only
// up to rounding.
inline Point<3> direction_at(const Point<2>& degrees) {
  const double lon = kDegree * degrees[0], lat = kDegree * degrees[1];
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// Returns the unit vector at x that points east along its parallel. At the poles it is the vector
// that longitude 0 has.
inline Point<3> east_at(const Point<3>& x) {
  const double across = std::hypot(x[0], x[1]);
  return across > 0 ? Point<3>{-x[1] / across, x[0] / across, 0} : Point<3>{0, 1, 0};
}

}  // namespace pnpbs
