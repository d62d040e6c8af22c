// SPDX-License-Identifier: BSD-3-Clause
// Limits on coordinates, and tolerances within which points count as equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/types.hpp"

namespace pnpbs {

// Largest coordinate and smallest size of a domain. Within these limits, products of four
// coordinate differences, as in the in-circle test, neither overflow nor lose digits in the
// subnormal range.
inline constexpr double kMaxCoordinate = 1e60;
inline constexpr double kSmallestDomain = 1e-60;

// Smallest size of a domain in units of its largest coordinate. It leaves enough digits to
// distinguish the points of a domain far from the origin.
inline constexpr double kSmallestRelativeSize = 1e-10;

// Distances below which points are equal, in units of the longest side of the domain's bounding
// box.
inline constexpr double kSamePoint = 1e-12;  // between vertices, or between a vertex and a segment
inline constexpr double kSameCurveEnd = 1e-9;  // if one of the points is the end of a curve
inline constexpr double kSameVertex = 1e-9;    // between vertices of surfaces in space

// Returns true if a coordinate is finite and not too large.
inline bool is_usable(double coordinate) {
  return std::fabs(coordinate) <= kMaxCoordinate;  // false for NaN
}
template <std::size_t Dim>
bool is_usable(const std::array<double, Dim>& point) {
  return std::all_of(point.begin(), point.end(), [](double x) { return is_usable(x); });
}

// Extends the box so that it contains the point.
template <int Dim>
void include(Box<Dim>& box, const std::type_identity_t<Point<Dim>>& point) {
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(box.low[k], point[k]);
    box.high[k] = std::max(box.high[k], point[k]);
  }
}

// Returns a box without points, which `include` can extend.
template <int Dim>
Box<Dim> empty_box() {
  Box<Dim> box;
  box.low.fill(HUGE_VAL);
  box.high.fill(-HUGE_VAL);
  return box;
}

// Returns the longest side of a box.
template <int Dim>
double size_of(const Box<Dim>& box) {
  double size = box.high[0] - box.low[0];
  for (int k = 1; k < Dim; ++k) size = std::max(size, box.high[k] - box.low[k]);
  return size;
}

// Returns the largest absolute value of a coordinate in the box.
template <int Dim>
double farthest_coordinate(const Box<Dim>& box) {
  double farthest = 0;
  for (int k = 0; k < Dim; ++k)
    farthest = std::max({farthest, std::fabs(box.low[k]), std::fabs(box.high[k])});
  return farthest;
}

}  // namespace pnpbs
