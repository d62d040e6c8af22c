// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/domain_extent.hpp"

#include <cmath>

#include "base/limits.hpp"
#include "domain/plane/sampling.hpp"
#include "predicates/expansion.hpp"

namespace pnpbs {

namespace {

// The true curve's points halfway between those of the polyline.
std::vector<Point<2>> middles(const BoundaryCurve& curve) {
  std::vector<double> t;
  for (std::size_t i = 0; i + 1 < curve.parameters.size(); ++i) {
    t.push_back(0.5 * curve.parameters[i] + 0.5 * curve.parameters[i + 1]);
  }
  return curve_points(curve.evaluate, t, curve.name);
}

}  // namespace

Extent extent_of(const std::vector<BoundaryCurve>& curves) {
  Box<2> box = empty_box<2>();
  for (const BoundaryCurve& curve : curves) {
    for (const Point<2>& point : curve.points) include(box, point);
  }
  const Point<2> origin = box.low;
  TwoTerms sum{0, 0};  // of twice the area
  const auto add = [&sum](double term) {
    const TwoTerms next = two_sum(sum.high, term);
    sum = {next.high, sum.low + next.low};
  };
  const auto cross = [&origin](const Point<2>& a, const Point<2>& b) {
    return (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
  };
  for (const BoundaryCurve& curve : curves) {
    const double sign = int{curve.left_inside} - int{curve.right_inside};
    const auto& p = curve.points;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) add(sign * cross(p[i], p[i + 1]));
    if (!curve.evaluate) continue;
    const std::vector<Point<2>> middle = middles(curve);
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      // Between chord and curve as under a parabola: 4/3 of the triangle's area.
      const double triangle = (middle[i][0] - p[i][0]) * (p[i + 1][1] - p[i][1]) -
                              (middle[i][1] - p[i][1]) * (p[i + 1][0] - p[i][0]);
      add(sign * 4 / 3 * triangle);
      // The curve goes beyond the middle by less than the middle does beyond the chord.
      const double sag_x = middle[i][0] - 0.5 * (p[i][0] + p[i + 1][0]);
      const double sag_y = middle[i][1] - 0.5 * (p[i][1] + p[i + 1][1]);
      include(box, {middle[i][0] + sag_x, middle[i][1] + sag_y});
    }
  }
  return {box, 0.5 * (sum.high + sum.low)};
}

}  // namespace pnpbs
