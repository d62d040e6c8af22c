// SPDX-License-Identifier: BSD-3-Clause
// A place of nodes as messages show it.
#pragma once

#include <string>

#include "base/point_text.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::tool {

// In all digits, so that it can be looked up; in degrees if it is on a sphere.
inline std::string place_text(const double* x, int dimension, bool on_sphere = false) {
  if (dimension == 2) return point_text(Point<2>{x[0], x[1]}).text();
  const Point<3> place{x[0], x[1], x[2]};
  return on_sphere ? "(" + degrees_text(degrees_of(place)) + ")" : point_text(place).text();
}

}  // namespace pnpbs::tool
