// SPDX-License-Identifier: BSD-3-Clause
#include "io/rows.hpp"

#include <cmath>

namespace pnpbs::io {

float quality_of(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const auto side = [](const Point<2>& u, const Point<2>& v) {
    return std::hypot(v[0] - u[0], v[1] - u[1]);
  };
  const double a = side(p, q), b = side(q, r), c = side(r, p);
  const double twice_area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  // In ratios, so that no product leaves the range of doubles.
  const double height = twice_area / a;
  const double value = 4 * (height / b) * (height / c) * (a / (a + b + c));
  return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
}

void prepare(Placement& placement, bool elements) {
  if (elements)
    placement.prepare_stars();
  else
    placement.prepare_order();
}

}  // namespace pnpbs::io
