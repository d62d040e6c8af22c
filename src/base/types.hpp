// SPDX-License-Identifier: BSD-3-Clause
// Points and boxes in 2 or 3 dimensions, and the Kokkos types all parts share.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace pnpbs {

template <int Dim>
using Point = std::array<double, Dim>;

template <int Dim>
struct Box {
  Point<Dim> low;
  Point<Dim> high;
};

template <int Dim>
inline Box<Dim> widened(Box<Dim> box, double way) {
  for (int k = 0; k < Dim; ++k) {
    box.low[k] -= way;
    box.high[k] += way;
  }
  return box;
}

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
