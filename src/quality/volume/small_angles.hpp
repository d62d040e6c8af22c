// SPDX-License-Identifier: BSD-3-Clause
// Small dihedral angles of tetrahedra, of which most have none.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Of the dihedral angles, between each two of the faces: 1 where a face has no area. The same bits
// for the same order of the corners, whatever their orientation.
inline std::array<double, 6> dihedral_cosines(const std::array<Point<3>, 4>& x) {
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  std::array<Point<3>, 4> normal{Point<3>{}, cross(w, v), cross(u, w), cross(v, u)};
  for (std::size_t k = 0; k < 3; ++k) normal[0][k] = -(normal[1][k] + normal[2][k] + normal[3][k]);
  std::array<double, 4> area;
  for (std::size_t f = 0; f < 4; ++f) area[f] = std::sqrt(dot(normal[f], normal[f]));
  std::array<double, 6> cosines;
  std::size_t edge = 0;
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t g = f + 1; g < 4; ++g) {
      const double product = area[f] * area[g];
      cosines[edge++] = product > 0 ? -dot(normal[f], normal[g]) / product : 1.0;
    }
  return cosines;
}

// A bound in degrees that angles are held against.
class SmallAngles {
 public:
  explicit SmallAngles(double below) : below_(below), cosine_(std::cos(below * kDegree)) {}

  bool any(const std::array<Point<3>, 4>& x) const {
    const std::array<double, 6> cosines = dihedral_cosines(x);
    return *std::max_element(cosines.begin(), cosines.end()) > cosine_;
  }

  // The sum of the squares of what angles lack.
  double penalty(const std::array<Point<3>, 4>& x) const {
    double sum = 0;
    for (const double cosine : dihedral_cosines(x)) {
      if (!(cosine > cosine_)) continue;
      const double lack = below_ - std::acos(std::min(cosine, 1.0)) / kDegree;
      sum += lack * lack;
    }
    return sum;
  }

 private:
  static constexpr double kDegree = std::numbers::pi / 180;
  double below_, cosine_;
};

}  // namespace pnpbs
