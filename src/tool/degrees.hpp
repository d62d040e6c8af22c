// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "base/types.hpp"

namespace pnpbs::tool {

// Longitude and latitude of a place x, y, z on a sphere about the origin; 0 and 0 at the origin,
// where formulas are tried.
inline Point<2> degrees_at(const double* x) {
  constexpr double degree = std::numbers::pi / 180;
  return {std::atan2(x[1], x[0]) / degree, std::atan2(x[2], std::hypot(x[0], x[1])) / degree};
}

}  // namespace pnpbs::tool
