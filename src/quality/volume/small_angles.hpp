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

// The faces of a tetrahedron: vectors normal to them, inwards or all outwards, twice as long as
// their areas, in the order of the opposite corners. The same bits for the same order of the
// corners, whatever their orientation.
inline std::array<Point<3>, 4> face_normals(const std::array<Point<3>, 4>& x) {
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  std::array<Point<3>, 4> normal{Point<3>{}, cross(w, v), cross(u, w), cross(v, u)};
  for (std::size_t k = 0; k < 3; ++k) normal[0][k] = -(normal[1][k] + normal[2][k] + normal[3][k]);
  return normal;
}

// A bound in degrees, of acute angles, that dihedral angles are held against: those between each
// two of the faces, 0 where a face has no area.
class SmallAngles {
 public:
  explicit SmallAngles(double below)
      : below_(below),
        cosine_(std::cos(below * kDegree)),
        surely_wide_((1 - kRounding) * cosine_ * cosine_) {}

  bool any(const std::array<Point<3>, 4>& x) const {
    bool found = false;
    for_small(x, [&](double) { found = true; });
    return found;
  }

  // Surely none, in whatever order the corners come? Nearly as often as there is none; of thin
  // tetrahedra that is not said.
  bool surely_none(const std::array<Point<3>, 4>& x) const {
    // With faces of this part of the longest edge's square, rounding changes cosines by less than
    // 1e-10.
    constexpr double kThin = 1e-6, kMargin = 1e-6;
    const std::array<Point<3>, 4> normal = face_normals(x);
    std::array<double, 4> square;
    for (std::size_t f = 0; f < 4; ++f) square[f] = dot(normal[f], normal[f]);
    double longest = 0;  // squared, of the edges at one corner: no edge is twice as long
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

  // The sum of the squares of what angles lack.
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
  static constexpr double kTiny = 1e-280;  // below it squares of areas have lost digits

  // Calls visit(cosine) for each angle below the bound. Most are not, as the squares show without
  // a root.
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
