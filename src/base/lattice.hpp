// SPDX-License-Identifier: BSD-3-Clause
// Properties of the lattice that bubbles settle into, for the plane and for space. Formulas of the
// method take their lattice constants from here.
#pragma once

#include <cmath>

namespace pnpbs {

template <int Dim>
struct Lattice;

// The hexagonal lattice of the plane. Every edge has the length d.
template <>
struct Lattice<2> {
  static constexpr double kDensity = 1.1547005383792515;  // nodes per d^2: 2 / sqrt(3)
  static constexpr int kNeighbours = 6;                   // Delaunay neighbours of a node
  static constexpr double kIdealOverlap = 6;              // overlap ratio of a node
  static constexpr int kOverlapEnd = 16;  // larger overlap ratios are counted as this one
};

// The body-centred cubic lattice of space. All its tetrahedra are congruent, no empty
// sphere passes through five nodes, and the midpoints of its edges form the lattice of half the
// spacing. A node has 8 edges along half diagonals of the cubic cell and 6 along its sides; d is
// the mean of their lengths.
template <>
struct Lattice<3> {
  static constexpr double kCell = 1.0829037686547607;     // side over d: 14 / (4 sqrt(3) + 6)
  static constexpr double kDensity = 1.5749268979030462;  // nodes per d^3: 2 / kCell^3
  static constexpr int kNeighbours = 14;
  static constexpr double kIdealOverlap = 14;  // an edge of length l adds 3 - 2 l / d
  static constexpr int kOverlapEnd = 32;
};

// Returns t^N for N >= 1. The factors are multiplied from left to right, so the rounding is fixed.
template <int N>
constexpr double power(double t) {
  double product = t;
  for (int k = 1; k < N; ++k) product *= t;
  return product;
}

// Returns the N-th root of t, N = 2 or 3.
template <int N>
double root(double t) {
  static_assert(N == 2 || N == 3);
  return N == 2 ? std::sqrt(t) : std::cbrt(t);
}

}  // namespace pnpbs
