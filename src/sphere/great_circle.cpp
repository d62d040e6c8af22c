// SPDX-License-Identifier: BSD-3-Clause
#include "sphere/great_circle.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs {

namespace {

struct SpherePoint {
  Point<3> direction;
  Point<2> in_chart;
};

// Returns the longest piece in radians on which a straight line of the chart is close enough to a
// great circle.
// Its curvature on the sphere is at most |u| / (2 R^2), the gradient of the stretch. Half of the
// turn over a piece is the angle with the great circle at the ends of the piece.
double longest_piece(double radius, const Point<2>& u) {
  constexpr double kAngle = 0.3 * kDegree, kLongest = 0.1;
  const double away = length(u) / radius;
  return std::min(kLongest, 4 * kAngle / away);
}

void add_between(const StereographicChart& chart, const SpherePoint& a, const SpherePoint& b,
                 std::vector<Point<2>>& points) {
  const Point<3> sum{a.direction[0] + b.direction[0], a.direction[1] + b.direction[1],
                     a.direction[2] + b.direction[2]};
  const Point<3> middle = unit_vector(sum);
  const SpherePoint m{middle, chart.in_chart(middle)};
  double longest = longest_piece(chart.radius(), m.in_chart);
  for (const SpherePoint* end : {&a, &b})
    longest = std::min(longest, longest_piece(chart.radius(), end->in_chart));
  if (!(longest > 0) || angle_between(a.direction, b.direction) <= longest) return;
  add_between(chart, a, m, points);
  points.push_back(m.in_chart);
  add_between(chart, m, b, points);
}

}  // namespace

double angle_between(const Point<3>& a, const Point<3>& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

double angle_to_arc(const Point<3>& x, const Point<3>& a, const Point<3>& b) {
  const Point<3> normal = cross(a, b);
  const bool is_beside = dot(cross(normal, a), x) > 0 && dot(cross(b, normal), x) > 0;
  if (!is_beside) return std::min(angle_between(x, a), angle_between(x, b));
  return std::fabs(std::asin(std::clamp(dot(unit_vector(normal), unit_vector(x)), -1.0, 1.0)));
}

std::vector<Point<2>> points_on_arc(const StereographicChart& chart, const Point<3>& a,
                                    const Point<3>& b) {
  std::vector<Point<2>> points;
  add_between(chart, {unit_vector(a), chart.in_chart(a)}, {unit_vector(b), chart.in_chart(b)},
              points);
  return points;
}

}  // namespace pnpbs
