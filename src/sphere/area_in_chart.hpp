// SPDX-License-Identifier: BSD-3-Clause
// Areas on a sphere from line integrals along their boundaries in a stereographic chart.
#pragma once

#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Returns the contribution of the straight segment from a to b to the area on the left of a closed
// polygon in the chart. `radius` is that of the sphere.
// With q = |u|^2 / (4 R^2), du dv / (1 + q)^2 is an area element on the sphere. It is the curl of
// (-v, u) / (2 (1 + q)), so the area is a line integral. On a segment its integrand is the constant
// (a x b) / 2 over a quadratic polynomial in the curve parameter.
inline double chart_area_term(const Point<2>& a, const Point<2>& b, double radius) {
  const Point<2> way{b[0] - a[0], b[1] - a[1]};
  const double unit = 4 * radius * radius;
  const double square = dot(way, way) / unit, linear = 2 * dot(a, way) / unit,
               constant = 1 + dot(a, a) / unit;
  const double root = std::sqrt(4 * square * constant - linear * linear);
  if (!(root > 0)) return 0;
  const double integral =
      2 / root * (std::atan((2 * square + linear) / root) - std::atan(linear / root));
  return 0.5 * (a[0] * b[1] - a[1] * b[0]) * integral;
}

}  // namespace pnpbs
