// SPDX-License-Identifier: BSD-3-Clause
// How large coordinates may be, and what counts as the same place.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace pnpbs {

// Products of four differences of coordinates, as the in-circle test has them, then neither
// overflow nor lose digits below the normal range.
inline constexpr double kMaxCoordinate = 1e60;
inline constexpr double kSmallestDomain = 1e-60;

// And this many digits of the coordinates must be left to tell places in it apart: of a domain far
// from the origin, in units of its largest coordinate.
inline constexpr double kSmallestRelativeSize = 1e-10;

// In units of the domain's size, which is the longer side of its bounding box.
inline constexpr double kSamePlace = 1e-12;    // vertices; a vertex and a segment
inline constexpr double kSameCurveEnd = 1e-9;  // where one of them is the end of a curve

inline bool is_usable(double coordinate) {
  return std::fabs(coordinate) <= kMaxCoordinate;  // false for NaN
}
inline bool is_usable(const Point<2>& point) { return is_usable(point[0]) && is_usable(point[1]); }

inline void include(Box<2>& box, const Point<2>& point) {
  for (const int k : {0, 1}) {
    box.low[k] = std::min(box.low[k], point[k]);
    box.high[k] = std::max(box.high[k], point[k]);
  }
}

inline double size_of(const Box<2>& box) {
  return std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
}

}  // namespace pnpbs
