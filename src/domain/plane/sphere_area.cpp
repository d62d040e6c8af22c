// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/sphere_area.hpp"

#include "sphere/area_in_chart.hpp"

namespace pnpbs {

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
