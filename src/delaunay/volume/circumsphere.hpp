// SPDX-License-Identifier: BSD-3-Clause
// The circumsphere of a tetrahedron and the circumcentre of a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/space_vectors.hpp"

namespace pnpbs {

using TetrahedronCorners = std::array<Point<3>, 4>;

inline double longest_edge(const TetrahedronCorners& x) {
  double square = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b) square = std::max(square, squared_distance<3>(x[a], x[b]));
  return std::sqrt(square);
}

struct Circumsphere {
  Point<3> centre;
  double radius;
  bool flat;  // Volume not distinguishable from rounding: centre and radius are invalid.
};

// Returns the circumsphere. The result is bitwise equal for the same order of the corners, whatever
// their orientation.
inline Circumsphere circumsphere(const TetrahedronCorners& x) {
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  const Point<3> vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const double volume = dot(u, vw);  // Six times the volume.
  // Far above the error of a determinant, from the differences of its rows and its own rounding,
  // and far below the volume of any useful tetrahedron.
  constexpr double kFlat = 0x1p-40;
  const bool flat = !(std::fabs(volume) > kFlat * std::sqrt(uu * vv) * std::sqrt(ww));
  Point<3> to_centre{};
  for (std::size_t k = 0; k < 3 && !flat; ++k)
    to_centre[k] = (uu * vw[k] + vv * wu[k] + ww * uv[k]) / (2 * volume);
  return {{x[0][0] + to_centre[0], x[0][1] + to_centre[1], x[0][2] + to_centre[2]},
          std::sqrt(dot(to_centre, to_centre)),
          flat};
}

// Returns the circumcentre. The result is bitwise equal for the same order of the corners.
inline Point<3> circle_centre(const std::array<Point<3>, 3>& x) {
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), normal = cross(u, v);
  const double uu = dot(u, u), vv = dot(v, v), twice = 2 * dot(normal, normal);
  const Point<3> along_v = cross(normal, u), along_u = cross(v, normal);
  Point<3> centre = x[0];
  for (std::size_t k = 0; k < 3; ++k) centre[k] += (vv * along_v[k] + uu * along_u[k]) / twice;
  return centre;
}

}  // namespace pnpbs
