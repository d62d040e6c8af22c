// SPDX-License-Identifier: BSD-3-Clause
// Bounding box and area of a domain.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

struct Extent {
  Box<2> bounds;
  double area;
};

// Of the curves around the inside, which know their sides. Between the points of a smooth curve as
// under a parabola through the middle.
Extent extent_of(const std::vector<BoundaryCurve>& curves);

}  // namespace pnpbs
