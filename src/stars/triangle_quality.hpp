// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/types.hpp"

namespace pnpbs {

// 2 r_in / R of a triangle: 1 if equilateral, 0 if flat, negative if turned over.
inline double triangle_quality(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double ab = distance<2>(a, b), bc = distance<2>(b, c), ca = distance<2>(c, a);
  const double product = ab * bc * ca * (ab + bc + ca);
  return product > 0 ? 4 * twice_area * std::fabs(twice_area) / product : 0.0;
}

}  // namespace pnpbs
