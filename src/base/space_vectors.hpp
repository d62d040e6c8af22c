// SPDX-License-Identifier: BSD-3-Clause
// Vector operations in space, and the same operations for the plane where they exist.
#pragma once

#include <cmath>
#include <cstddef>

#include "base/types.hpp"

namespace pnpbs {

inline Point<3> difference(const Point<3>& a, const Point<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double dot(const Point<2>& a, const Point<2>& b) { return a[0] * b[0] + a[1] * b[1]; }

inline double dot(const Point<3>& a, const Point<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Point<2>& a) { return std::sqrt(dot(a, a)); }

inline double length(const Point<3>& a) { return std::sqrt(dot(a, a)); }

// Returns a + t b.
inline Point<3> shifted(const Point<3>& a, double t, const Point<3>& b) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}

// Returns the midpoint of a and b. It is rounded like the other points of the segment, so its last
// bits may differ from those of middle_of(a, b).
inline Point<3> halfway(const Point<3>& a, const Point<3>& b) {
  return shifted(a, 0.5, difference(b, a));
}

// Returns a vector of length 1 in the direction of a, or 0 if a is 0.
inline Point<3> unit_vector(const Point<3>& a) {
  const double whole = length(a);
  return whole > 0 ? Point<3>{a[0] / whole, a[1] / whole, a[2] / whole} : Point<3>{};
}

// Returns the component of a that is perpendicular to a unit vector.
inline Point<3> part_across(const Point<3>& a, const Point<3>& unit) {
  return shifted(a, -dot(a, unit), unit);
}

}  // namespace pnpbs
