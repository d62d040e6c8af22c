// SPDX-License-Identifier: BSD-3-Clause
// Quality and dihedral angles of tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "delaunay/volume/circumsphere.hpp"

namespace pnpbs {

// Returns the quality 3 r_in / R: 1 if regular, 0 if flat, negative if negatively oriented.
inline double tetrahedron_quality(const TetrahedronCorners& x) {
  const Circumsphere sphere = circumsphere(x);
  if (sphere.flat) return 0;
  double area = 0;  // twice the surface area
  for (std::size_t top = 0; top < 4; ++top) {
    const Point<3>&a = x[(top + 1) % 4], &b = x[(top + 2) % 4], &c = x[(top + 3) % 4];
    const Point<3> normal = cross(difference(b, a), difference(c, a));
    area += std::sqrt(dot(normal, normal));
  }
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  return 3 * dot(u, cross(v, w)) / (area * sphere.radius);
}

// Returns the dihedral angles at the edges 01, 02, 03, 12, 13 and 23, from 0 to 180. [degrees]
// Returns 0 at an edge of length 0 and beside a face of area 0.
inline std::array<double, 6> dihedral_angles(const TetrahedronCorners& x) {
  constexpr std::size_t kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                        {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  std::array<double, 6> angles{};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [a, b, c, d] = kEdges[e];
    const Point<3> edge = difference(x[b], x[a]);
    const Point<3> to_c = cross(edge, difference(x[c], x[a]));
    const Point<3> to_d = cross(edge, difference(x[d], x[a]));
    // Both vectors are normal to faces and oriented alike, so the angle between them is the
    // dihedral angle.
    const Point<3> sine = cross(to_c, to_d);
    angles[e] = std::atan2(std::sqrt(dot(sine, sine)), dot(to_c, to_d)) * 180 / std::numbers::pi;
  }
  return angles;
}

inline double min_dihedral_angle(const TetrahedronCorners& x) {
  const std::array<double, 6> angles = dihedral_angles(x);
  return *std::min_element(angles.begin(), angles.end());
}

}  // namespace pnpbs
