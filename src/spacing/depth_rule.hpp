// SPDX-License-Identifier: BSD-3-Clause
// The spacing of tide and surge models from the water depth: a number of nodes per length of a long
// wave, and per length over which the depth changes by its own size.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pnpbs {

// Parameters of the rule, and the rule itself.
struct DepthRule {
  double wave = 30;       // nodes per wavelength sqrt(g h) T; 0: no such rule
  double period = 44712;  // T [s], by default that of the tide M2, 12.42 hours
  double slope = 0;       // nodes per 2 pi h / |grad h|; 0: no such rule
  // Smallest h [m]; shallower water and land count as a flat bottom at this depth.
  double least = 10;
  double metres = 1;  // [metres per unit of length]

  // Returns d for a depth, positive downwards [m], and its slope [m per unit of length]. Returns
  // NaN for a depth of NaN. The slope rule is that of Hannah and Wright (1995), as in OceanMesh2D
  // (Roberts, Pringle and Westerink, Geosci. Model Dev. 12, 2019).
  double spacing(double depth, double slope_there) const {
    constexpr double g = 9.81;  // m/s^2
    const double h = std::max(depth, least);
    double d = std::numeric_limits<double>::infinity();
    if (wave > 0) d = std::sqrt(g * h) * period / (wave * metres);
    if (slope > 0 && depth > least && slope_there > 0)
      d = std::min(d, 2 * std::numbers::pi * h / (slope * slope_there));
    return std::isnan(depth) ? depth : d;
  }
};

}  // namespace pnpbs
