// SPDX-License-Identifier: BSD-3-Clause
#include "sphere/stereographic_chart.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

// East is along the equator of the coordinates, so that charts about a pole have the orientation of
// usual maps.
StereographicChart::StereographicChart(double radius, const Point<3>& from) : radius_(radius) {
  const Point<3> down = unit_vector(from);
  up_ = {-down[0], -down[1], -down[2]};
  const Point<3> pole{0, 0, 1}, along = cross(pole, up_);
  east_ = length(along) > 1e-12 ? unit_vector(along) : Point<3>{1, 0, 0};
  north_ = cross(up_, east_);
}

Point<3> StereographicChart::projection_centre() const {
  return {-radius_ * up_[0], -radius_ * up_[1], -radius_ * up_[2]};
}

// With t the angle from `up`, 2 tan(t / 2) is 2 sin t / (1 + cos t) and 2 (1 - cos t) / sin t. Each
// branch uses the expression without cancellation.
Point<2> StereographicChart::in_chart(const Point<3>& x) const {
  const Point<3> at = unit_vector(x);
  const double a = dot(at, east_), b = dot(at, north_), c = dot(at, up_);
  const double square = a * a + b * b;
  const double factor = c >= 0 ? 2 / (1 + c) : 2 * (1 - c) / square;
  return {radius_ * factor * a, radius_ * factor * b};
}

Point<3> StereographicChart::on_sphere(const Point<2>& u) const {
  const double a = u[0] / (2 * radius_), b = u[1] / (2 * radius_), square = a * a + b * b;
  const double across = 2 * radius_ / (1 + square), along = radius_ * (1 - square) / (1 + square);
  Point<3> x;
  for (std::size_t k = 0; k < 3; ++k)
    x[k] = across * (a * east_[k] + b * north_[k]) + along * up_[k];
  return x;
}

double StereographicChart::stretch(const Point<2>& u) const {
  return 1 + dot(u, u) / (4 * radius_ * radius_);
}

double StereographicChart::min_stretch_in(const Box<2>& box) const {
  Point<2> near;
  for (std::size_t k = 0; k < 2; ++k) near[k] = std::clamp(0.0, box.low[k], box.high[k]);
  return stretch(near);
}

double StereographicChart::max_stretch_in(const Box<2>& box) const {
  Point<2> far;
  for (std::size_t k = 0; k < 2; ++k)
    far[k] = std::fabs(box.low[k]) > std::fabs(box.high[k]) ? box.low[k] : box.high[k];
  return stretch(far);
}

bool StereographicChart::varies_much_in(const Box<2>& box) const {
  constexpr double kMuch = 4;
  return max_stretch_in(box) > kMuch * min_stretch_in(box);
}

double StereographicChart::relative_growth(const Point<2>& u) const {
  return std::hypot(u[0], u[1]) / (2 * radius_ * radius_) / stretch(u);
}

double StereographicChart::distance(const Point<2>& u, const Point<2>& v) const {
  const double chord = pnpbs::distance<2>(u, v) / std::sqrt(stretch(u) * stretch(v));
  return 2 * radius_ * std::asin(std::min(1.0, chord / (2 * radius_)));
}

}  // namespace pnpbs
