// SPDX-License-Identifier: BSD-3-Clause
// Arcs, areas and circumcentres on the unit sphere about the origin. Points are unit vectors.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs {

// Returns the length of the arc between two points at a straight distance of `chord`.
inline double arc_over(double chord) { return 2 * std::asin(std::min(1.0, 0.5 * chord)); }

inline double arc(const Point<3>& a, const Point<3>& b) {
  return arc_over(length(difference(a, b)));
}

inline Point<3> arc_middle(const Point<3>& a, const Point<3>& b) {
  return unit_vector({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
}

// Returns a complex number whose argument is half the area of a triangle (A. van Oosterom and J.
// Strackee, IEEE Transactions on Biomedical Engineering 30 (1983), 125-126). Its absolute value is
// about 4 for a small triangle. The volume is computed from differences, because most triangles are
// small.
inline Point<2> half_area_direction(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const double volume = dot(a, cross(difference(b, a), difference(c, a)));
  return {1 + dot(a, b) + dot(b, c) + dot(c, a), volume};
}

// Returns the area, which is positive if the corners are counter-clockwise seen from outside.
inline double signed_area(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const auto [real, imaginary] = half_area_direction(a, b, c);
  return 2 * std::atan2(imaginary, real);
}

// Returns the point of the sphere with equal distances to the three corners: the direction of the
// circumcentre in space. The normal of the plane has the same direction, but its error is larger by
// the ratio of the sphere's radius to the triangle's size.
inline Point<3> circumcentre(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Point<3> u = difference(b, a), v = difference(c, a), normal = cross(u, v);
  const Point<3> to_u = cross(v, normal), to_v = cross(normal, u);
  const double uu = dot(u, u), vv = dot(v, v), twice = 2 * dot(normal, normal);
  Point<3> centre;
  for (std::size_t k = 0; k < 3; ++k) centre[k] = a[k] + (uu * to_u[k] + vv * to_v[k]) / twice;
  return unit_vector(centre);
}

// Returns the angle in radians, -pi .. pi, at the point `at` from east to the direction from a to
// b. It is positive towards north. `at` lies between a and b.
inline double angle_to_east(const Point<3>& at, const Point<3>& a, const Point<3>& b) {
  const Point<3> east = east_at(at);
  const Point<3> way = difference(b, a);
  return std::atan2(dot(way, cross(at, east)), dot(way, east));
}

}  // namespace pnpbs
