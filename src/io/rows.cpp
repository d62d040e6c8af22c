// SPDX-License-Identifier: BSD-3-Clause
#include "io/rows.hpp"

#include <cmath>

#include "quality/volume/tetrahedron_quality.hpp"

namespace pnpbs::io {

namespace {

float as_written(double quality) {
  return std::isfinite(quality) ? static_cast<float>(quality) : 0.0F;
}

// Returns the quality of a triangle from its side lengths and twice its area.
float quality_of(double a, double b, double c, double twice_area) {
  // Uses ratios, so that no product overflows.
  const double height = twice_area / a;
  return as_written(4 * (height / b) * (height / c) * (a / (a + b + c)));
}

}  // namespace

float quality_of(const std::array<Point<2>, 3>& triangle) {
  const auto& [p, q, r] = triangle;
  const auto side = [](const Point<2>& u, const Point<2>& v) {
    return std::hypot(v[0] - u[0], v[1] - u[1]);
  };
  return quality_of(side(p, q), side(q, r), side(r, p),
                    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}

float quality_of(const std::array<Point<3>, 3>& triangle) {
  const auto& [p, q, r] = triangle;
  const auto length = [](const Point<3>& u) { return std::hypot(u[0], u[1], u[2]); };
  return quality_of(length(difference(q, p)), length(difference(r, q)), length(difference(p, r)),
                    length(cross(difference(q, p), difference(r, p))));
}

float quality_of(const std::array<Point<3>, 4>& tetrahedron) {
  return as_written(tetrahedron_quality(tetrahedron));
}

void prepare(NodalResults& results, bool elements) {
  if (elements)
    results.prepare_stars();
  else
    results.prepare_order();
}

}  // namespace pnpbs::io
