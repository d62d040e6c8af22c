// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a facet, in space: a triangle. Two corners in one place make it a segment, three
// a point; these bound nothing, but are near, touched and met as triangles are.
#pragma once

#include <array>
#include <cstddef>

#include "base/space_vectors.hpp"
#include "geometry/boundary_mesh.hpp"
#include "geometry/boxes_apart.hpp"
#include "predicates/space.hpp"

namespace pnpbs {

inline Point<3> centroid(const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  Point<3> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (a[k] + b[k] + c[k]) / 3;
  return middle;
}

// Normal to it, as long as its area.
inline Point<3> area_normal(const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  return shifted({}, 0.5, cross(difference(b, a), difference(c, a)));
}

// On which side of the line pq is that through a and b, as p sees it? With the sign of
// orientation(p, q, a, b), or where that is 0 of what it would be if the line were shifted by
// (e, e^2, e^3) for a tiny e; 0 only where the two lines are parallel.
int side_of_line(const Point<3>& p, const Point<3>& q, const Point<3>& a, const Point<3>& b);

// Does the way from p to q cross the triangle? Where it meets an edge or a corner, the way next to
// it counts that side_of_line tells, so that it crosses as many of the triangles there as it
// should. Not where the way begins or ends on the triangle.
inline bool crosses(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  if (boxes_are_apart(p, q, triangle)) return false;  // most are
  const auto& [a, b, c] = triangle;
  if (orientation(a, b, c, p) * orientation(a, b, c, q) >= 0) return false;
  const int side = side_of_line(p, q, a, b);
  return side == side_of_line(p, q, b, c) && side == side_of_line(p, q, c, a);
}

// Has the way from p to q, its ends included, a point in common with the triangle? Never says no
// where it has; where all lie in a plane, yes if its line meets the triangle or their boxes meet.
bool may_touch(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

// Is x exactly on the triangle, its edges and corners included?
bool on_facet(const FacetCorners<3>& triangle, const Point<3>& x);

// May the triangle meet the closed box? Never says no where it does (rounding counts as meeting).
bool may_meet_box(const FacetCorners<3>& triangle, const Box<3>& box);
bool segment_may_meet_box(const Point<3>& a, const Point<3>& b, const Box<3>& box);

// A point of a triangle: its first corner and so much of the ways from there to the other two.
struct TrianglePoint {
  Point<3> x;
  std::array<double, 2> along;
};

// The point of the triangle nearest to x. Where that is on an edge, two triangles that both have
// the edge, its corners in the same order, tell the same point to the bit.
TrianglePoint nearest_triangle_point(const FacetCorners<3>& triangle, const Point<3>& x);

inline Point<3> nearest_on(const FacetCorners<3>& triangle, const Point<3>& x) {
  return nearest_triangle_point(triangle, x).x;
}

}  // namespace pnpbs
