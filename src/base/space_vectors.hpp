// SPDX-License-Identifier: BSD-3-Clause
// Vectors in space, and what has the same name in the plane.
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

// a + t b
inline Point<3> shifted(const Point<3>& a, double t, const Point<3>& b) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}

// Rounded as the other points on the way from a to b, so not always middle_of to the last bit.
inline Point<3> halfway(const Point<3>& a, const Point<3>& b) {
  return shifted(a, 0.5, difference(b, a));
}

// Of length 1; that of 0 is 0.
inline Point<3> unit_vector(const Point<3>& a) {
  const double whole = length(a);
  return whole > 0 ? Point<3>{a[0] / whole, a[1] / whole, a[2] / whole} : Point<3>{};
}

// The part of a that is at right angles to a unit vector.
inline Point<3> part_across(const Point<3>& a, const Point<3>& unit) {
  return shifted(a, -dot(a, unit), unit);
}

}  // namespace pnpbs
