// SPDX-License-Identifier: BSD-3-Clause
// Points and boxes in two or three dimensions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace pnpbs {

// A point or a vector.
template <int Dim>
using Point = std::array<double, Dim>;

// An axis-aligned box.
template <int Dim>
struct Box {
  Point<Dim> low;
  Point<Dim> high;
};

// Returns the box enlarged by `way` on all sides.
template <int Dim>
inline Box<Dim> widened(Box<Dim> box, double way) {
  for (int k = 0; k < Dim; ++k) {
    box.low[k] -= way;
    box.high[k] += way;
  }
  return box;
}

// Returns the box of all points whose coordinates differ from those of x by at most `reach`.
template <int Dim>
inline Box<Dim> box_around(const Point<Dim>& x, double reach) {
  return widened(Box<Dim>{x, x}, reach);
}

template <int Dim>
inline Point<Dim> middle_of(const Point<Dim>& a, const Point<Dim>& b) {
  Point<Dim> middle;
  for (int k = 0; k < Dim; ++k) middle[k] = 0.5 * (a[k] + b[k]);
  return middle;
}

template <int Dim>
inline double squared_distance(const Point<Dim>& a, const Point<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

template <int Dim>
inline double distance(const Point<Dim>& a, const Point<Dim>& b) {
  return std::sqrt(squared_distance<Dim>(a, b));
}

}  // namespace pnpbs
