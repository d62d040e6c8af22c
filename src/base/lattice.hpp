// SPDX-License-Identifier: BSD-3-Clause
// The lattice that bubbles settle into, and the numbers of the method that follow from it: what a
// formula would otherwise say with a 2 or a 6 of the plane.
#pragma once

#include <cmath>

namespace pnpbs {

template <int Dim>
struct Lattice;

// The plane's: hexagonal, every edge d.
template <>
struct Lattice<2> {
  static constexpr double kDensity = 1.1547005383792515;  // nodes per d^2: 2 / sqrt(3)
  static constexpr int kNeighbours = 6;                   // by edges of the Delaunay triangulation
  static constexpr double kIdealOverlap = 6;              // overlap ratio of a node
  static constexpr int kOverlapEnd = 16;                  // larger ratios are not told apart
};

// The volume's: body-centred cubic. All its tetrahedra are alike, nothing is cospherical, and the
// midpoints of its edges make the lattice of half the spacing. d is the mean of a node's edges: 8
// along half diagonals of the cubic cell and 6 along its sides.
template <>
struct Lattice<3> {
  static constexpr double kCell = 1.0829037686547607;     // its side over d: 14 / (4 sqrt(3) + 6)
  static constexpr double kDensity = 1.5749268979030462;  // nodes per d^3: 2 / kCell^3
  static constexpr int kNeighbours = 14;
  static constexpr double kIdealOverlap = 14;  // each edge adds 3 - 2 l / d
  static constexpr int kOverlapEnd = 32;
};

// t^N for N >= 1, multiplied from the left.
template <int N>
constexpr double power(double t) {
  double product = t;
  for (int k = 1; k < N; ++k) product *= t;
  return product;
}

// The N-th root of t, N = 2 or 3.
template <int N>
double root(double t) {
  static_assert(N == 2 || N == 3);
  return N == 2 ? std::sqrt(t) : std::cbrt(t);
}

}  // namespace pnpbs
