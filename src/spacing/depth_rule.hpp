// SPDX-License-Identifier: BSD-3-Clause
// d of models of tides and surges, by the depth of the water: so many nodes per length of a long
// wave, and per length over which the depth changes by itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pnpbs {

struct DepthRule {
  double wave = 30;       // nodes per wavelength sqrt(g h) T; 0: no such rule
  double period = 44712;  // T in seconds: that of M2, 12.42 hours
  double slope = 0;       // nodes per 2 pi h / |grad h|; 0: no such rule
  double least = 10;      // metres, of h: shallower water and land are a flat bottom at this depth
  double metres = 1;      // per unit of length

  // The depth in metres, positive down, its slope in metres per unit of length. The rule of slopes
  // is that of Hannah and Wright (1995), as OceanMesh2D has it (Roberts, Pringle and Westerink,
  // Geosci. Model Dev. 12, 2019).
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
