// SPDX-License-Identifier: BSD-3-Clause
#include "picture/cut_plane.hpp"

#include <algorithm>
#include <cmath>

#include "picture/lettering.hpp"

namespace pnpbs::picture {

bool CutPlane::meets(const Box<3>& box) const {
  Point<3> middle{};
  double reach = 0;  // half the extent of the box along the normal
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = box.low[k] + 0.5 * (box.high[k] - box.low[k]);
    reach += std::fabs(normal[k]) * 0.5 * (box.high[k] - box.low[k]);
  }
  return std::fabs(height(middle)) < reach;
}

CutPlane plane_across(int axis, double place) {
  const double sign = axis == 1 ? -1 : 1;
  CutPlane plane{{}, sign * place, std::string(1, "xyz"[axis]) + " = " + short_number(place)};
  plane.normal[static_cast<std::size_t>(axis)] = sign;
  return plane;
}

CutPlane middle_plane(const Box<3>& box) {
  const auto extent = [&box](std::size_t k) { return box.high[k] - box.low[k]; };
  std::size_t shortest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (extent(k) < extent(shortest)) shortest = k;
  return plane_across(static_cast<int>(shortest), box.low[shortest] + 0.5 * extent(shortest));
}

}  // namespace pnpbs::picture
