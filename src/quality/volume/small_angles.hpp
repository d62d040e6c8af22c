// SPDX-License-Identifier: BSD-3-Clause
// Tests for small dihedral angles of tetrahedra, optimised for the usual case without any.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Returns the normals of the faces of a tetrahedron, in the order of the opposite corners. They all
// point inwards or all outwards, and their lengths are twice the areas. The same order of the
// corners gives the same bits for either orientation.
inline std::array<Point<3>, 4> face_normals(const std::array<Point<3>, 4>& x) {
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  std::array<Point<3>, 4> normal{Point<3>{}, cross(w, v), cross(u, w), cross(v, u)};
  for (std::size_t k = 0; k < 3; ++k) normal[0][k] = -(normal[1][k] + normal[2][k] + normal[3][k]);
  return normal;
}

// A bound for the dihedral angles of tetrahedra. It must be an acute angle in degrees. An angle
// counts as 0 at a face without area.
class SmallAngles {
 public:
  explicit SmallAngles(double below)
      : below_(below),
        cosine_(std::cos(below * kDegree)),
        surely_wide_((1 - kRounding) * cosine_ * cosine_) {}

  // Returns whether any dihedral angle is below the bound.
  bool any(const std::array<Point<3>, 4>& x) const {
    bool found = false;
    for_small(x, [&](double) { found = true; });
    return found;
  }

  // Returns whether certainly no angle is below the bound, for any order of the corners. May return
  // false for a tetrahedron without a small angle, always so for thin ones.
  bool surely_none(const std::array<Point<3>, 4>& x) const {
    // Rounding changes cosines by less than 1e-10 if all faces are larger than this share of the
    // longest edge's square.
    constexpr double kThin = 1e-6, kMargin = 1e-6;
    const std::array<Point<3>, 4> normal = face_normals(x);
    std::array<double, 4> square;
    for (std::size_t f = 0; f < 4; ++f) square[f] = dot(normal[f], normal[f]);
    double longest = 0;  // squared, over the edges at one corner; no other edge is twice as long
    for (std::size_t k = 1; k < 4; ++k) {
      const Point<3> edge = difference(x[k], x[0]);
      longest = std::max(longest, dot(edge, edge));
    }
    const double least = std::min({square[0], square[1], square[2], square[3]});
    bool none = least > kThin * longest * longest && least * least > kTiny;
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t g = f + 1; g < 4; ++g) {
        const double product = -dot(normal[f], normal[g]), limit = square[f] * square[g];
        none &= product <= 0 || product * product < (1 - kMargin) * surely_wide_ * limit;
      }
    return none;
  }

  // Returns the sum over all angles below the bound of (bound - angle)^2. [degrees^2]
  double penalty(const std::array<Point<3>, 4>& x) const {
    double sum = 0;
    for_small(x, [&](double cosine) {
      const double lack = below_ - std::acos(std::min(cosine, 1.0)) / kDegree;
      sum += lack * lack;
    });
    return sum;
  }

 private:
  static constexpr double kDegree = std::numbers::pi / 180;
  static constexpr double kRounding = 1e-12;
  // below it, squares of areas have lost digits to underflow
  static constexpr double kTiny = 1e-280;

  // Calls visit(cosine) for each angle below the bound. Comparing squares avoids a square root for
  // most angles.
  template <class Visit>
  void for_small(const std::array<Point<3>, 4>& x, const Visit& visit) const {
    const std::array<Point<3>, 4> normal = face_normals(x);
    std::array<double, 4> square;
    for (std::size_t f = 0; f < 4; ++f) square[f] = dot(normal[f], normal[f]);
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t g = f + 1; g < 4; ++g) {
        const double product = -dot(normal[f], normal[g]), limit = square[f] * square[g];
        if (limit > kTiny && (product <= 0 || product * product < surely_wide_ * limit)) continue;
        const double areas = std::sqrt(square[f]) * std::sqrt(square[g]);
        const double cosine = areas > 0 ? product / areas : 1.0;
        if (cosine > cosine_) visit(cosine);
      }
  }

  double below_, cosine_, surely_wide_;
};

}  // namespace pnpbs
