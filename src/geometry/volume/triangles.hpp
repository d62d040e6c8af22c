// SPDX-License-Identifier: BSD-3-Clause
// The geometric operations on a facet in space, which is a triangle. A triangle with two equal
// corners is a segment, one with three a point. These do not bound the domain, but distances and
// contacts are defined for them as for triangles.
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

// Returns a normal of the triangle whose length is its area.
inline Point<3> area_normal(const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  return shifted({}, 0.5, cross(difference(b, a), difference(c, a)));
}

// Returns the side of line ab relative to line pq: the sign of orientation(p, q, a, b). If that is
// 0, it returns the sign for a line pq shifted by (e, e^2, e^3) with a tiny e. It is 0 only if the
// two lines are parallel.
int side_of_line(const Point<3>& p, const Point<3>& q, const Point<3>& a, const Point<3>& b);

// Returns whether segment pq crosses the triangle. If the segment meets an edge or a corner, the
// shift of side_of_line decides, so that it crosses a consistent number of the triangles there. The
// segment must not begin or end on the triangle.
inline bool crosses(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  if (boxes_are_apart(p, q, triangle)) return false;  // Excludes most triangles.
  const auto& [a, b, c] = triangle;
  if (orientation(a, b, c, p) * orientation(a, b, c, q) >= 0) return false;
  const int side = side_of_line(p, q, a, b);
  return side == side_of_line(p, q, b, c) && side == side_of_line(p, q, c, a);
}

// Returns whether closed segment pq and the triangle may intersect. It never returns false for an
// intersection. If all points lie in a plane, it can return true without one.
bool may_touch(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

// Returns whether x lies exactly on the closed triangle.
bool on_facet(const FacetCorners<3>& triangle, const Point<3>& x);

// Return whether a triangle or a segment may meet the closed box. Rounding can lead to true without
// an intersection, but never to false with one.
bool may_meet_box(const FacetCorners<3>& triangle, const Box<3>& box);
bool segment_may_meet_box(const Point<3>& a, const Point<3>& b, const Box<3>& box);

// A point of a triangle, with its coordinates along the edges from corner 0 to corners 1 and 2.
struct TrianglePoint {
  Point<3> x;
  std::array<double, 2> along;
};

// Returns the point of the triangle nearest to x. If it lies on an edge that two triangles share
// with its corners in the same order, both return bitwise the same point.
TrianglePoint nearest_triangle_point(const FacetCorners<3>& triangle, const Point<3>& x);

inline Point<3> nearest_on(const FacetCorners<3>& triangle, const Point<3>& x) {
  return nearest_triangle_point(triangle, x).x;
}

}  // namespace pnpbs
