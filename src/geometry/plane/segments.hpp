// SPDX-License-Identifier: BSD-3-Clause
// Elementary operations on straight segments in the plane.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace pnpbs {

// Returns the point of segment ab nearest to x.
inline Point<2> nearest_on_segment(const Point<2>& a, const Point<2>& b, const Point<2>& x) {
  const double ux = b[0] - a[0], uy = b[1] - a[1];
  const double length2 = ux * ux + uy * uy;
  if (length2 == 0) return a;
  const double t = ((x[0] - a[0]) * ux + (x[1] - a[1]) * uy) / length2;
  if (t <= 0) return a;
  if (t >= 1) return b;
  return {a[0] + t * ux, a[1] + t * uy};
}

inline double distance_to_segment(const Point<2>& a, const Point<2>& b, const Point<2>& x) {
  return distance<2>(nearest_on_segment(a, b, x), x);
}

// Returns whether segment ab may meet the closed box. Rounding can lead to true without an
// intersection, but never to false with one.
inline bool segment_may_meet_box(const Point<2>& a, const Point<2>& b, const Box<2>& box) {
  for (int k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < box.low[k] || std::min(a[k], b[k]) > box.high[k]) return false;
  const double nx = a[1] - b[1], ny = b[0] - a[0];
  const double cx = 0.5 * (box.low[0] + box.high[0]), cy = 0.5 * (box.low[1] + box.high[1]);
  const double hx = 0.5 * (box.high[0] - box.low[0]), hy = 0.5 * (box.high[1] - box.low[1]);
  const double offset = std::fabs(nx * (cx - a[0]) + ny * (cy - a[1]));
  const double reach = std::fabs(nx) * hx + std::fabs(ny) * hy;
  return offset <= reach * (1 + 1e-9) + 1e-13 * offset;
}

// Returns the rounded intersection of lines ab and cd, clamped to segment ab. It is the middle of
// ab if the lines are parallel.
inline Point<2> crossing_point(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                               const Point<2>& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1];
  const double vx = d[0] - c[0], vy = d[1] - c[1];
  const double determinant = ux * vy - uy * vx;
  const double along = (c[0] - a[0]) * vy - (c[1] - a[1]) * vx;
  const double fraction = determinant == 0 ? 0.5 : std::clamp(along / determinant, 0.0, 1.0);
  return {a[0] + fraction * ux, a[1] + fraction * uy};
}

}  // namespace pnpbs
