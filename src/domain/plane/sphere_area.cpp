// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/sphere_area.hpp"

#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// With q = |u|^2 / (4 R^2), du dv / (1 + q)^2 is an area on the sphere, and the curl of
// (-v, u) / (2 (1 + q)). Along a straight segment from a to b that is a x b / 2, a constant, over a
// quadratic function of the way: its integral.
double area_beside(const Point<2>& a, const Point<2>& b, double radius) {
  const Point<2> way{b[0] - a[0], b[1] - a[1]};
  const double unit = 4 * radius * radius;
  const double square = dot(way, way) / unit, linear = 2 * dot(a, way) / unit,
               constant = 1 + dot(a, a) / unit;
  const double root = std::sqrt(4 * square * constant - linear * linear);
  if (!(root > 0)) return 0;
  const double integral = 2 / root *
                          (std::atan((2 * square + linear) / root) - std::atan(linear / root));
  return 0.5 * (a[0] * b[1] - a[1] * b[0]) * integral;
}

}  // namespace

double area_on_sphere(const PlaneDomain& domain) {
  double area = 0;
  for (const BoundaryCurve& curve : domain.curves()) {
    if (curve.left_inside == curve.right_inside) continue;
    double beside = 0;
    for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
      beside += area_beside(curve.points[p], curve.points[p + 1], domain.chart()->radius());
    area += curve.left_inside ? beside : -beside;
  }
  return area;
}

}  // namespace pnpbs
