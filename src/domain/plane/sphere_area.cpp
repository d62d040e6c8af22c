// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/sphere_area.hpp"

#include <numbers>

#include "sphere/area_in_chart.hpp"

namespace pnpbs {

double area_on_sphere(const PlaneDomain& domain) {
  const double radius = domain.embedding().radius();
  if (domain.is_whole_sphere()) return 4 * std::numbers::pi * radius * radius;
  double area = 0;
  for (const BoundaryCurve& curve : domain.curves()) {
    if (!curve.bounds()) continue;
    double beside = 0;
    for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
      beside += area_beside(curve.points[p], curve.points[p + 1], radius);
    area += curve.left_inside ? beside : -beside;
  }
  return area;
}

}  // namespace pnpbs
