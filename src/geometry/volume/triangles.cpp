// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/triangles.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// Projects a point along axis k. The remaining coordinates are in cyclic order.
Point<2> along(int k, const Point<3>& x) {
  return {x[static_cast<std::size_t>((k + 1) % 3)], x[static_cast<std::size_t>((k + 2) % 3)]};
}

bool all_on_one_side(std::initializer_list<int> sides) {
  bool left = false, right = false;
  for (const int side : sides) {
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

struct SegmentPoint {
  Point<3> x;
  double along;
};

SegmentPoint nearest_on_segment(const Point<3>& a, const Point<3>& b, const Point<3>& x) {
  const Point<3> way = difference(b, a);
  const double length2 = dot(way, way);
  if (length2 == 0) return {a, 0};
  const double t = dot(difference(x, a), way) / length2;
  if (t <= 0) return {a, 0};
  if (t >= 1) return {b, 1};
  SegmentPoint nearest{{}, t};
  for (std::size_t k = 0; k < 3; ++k)
    nearest.x[k] = std::clamp(a[k] + t * way[k], std::min(a[k], b[k]), std::max(a[k], b[k]));
  return nearest;
}

// Returns whether the projections of a closed box and of the convex hull of points onto `axis` are
// disjoint by more than the rounding error. Positions are relative to the middle of the box.
template <std::size_t N>
bool apart_along(const Point<3>& axis, const Point<3>& half, const std::array<Point<3>, N>& points,
                 double farthest) {
  constexpr double kRounding = 32 * 0x1p-52;
  double low = dot(axis, points[0]), high = low, reach = 0, length = 0;
  for (const Point<3>& x : points) {
    low = std::min(low, dot(axis, x));
    high = std::max(high, dot(axis, x));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    reach += std::fabs(axis[k]) * half[k];
    length += std::fabs(axis[k]);
  }
  reach += kRounding * (reach + length * farthest);
  return low > reach || high < -reach;
}

// Tests all axes along which two convex bodies can be separated: normals of faces, and cross
// products of an edge of each (Gottschalk 1996).
template <std::size_t N>
bool hull_may_meet_box(std::array<Point<3>, N> points, const Box<3>& box) {
  Point<3> half, middle;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = points[0][k], high = low;
    for (const Point<3>& x : points) {
      low = std::min(low, x[k]);
      high = std::max(high, x[k]);
    }
    if (high < box.low[k] || low > box.high[k]) return false;
    half[k] = 0.5 * (box.high[k] - box.low[k]);
    middle[k] = 0.5 * (box.low[k] + box.high[k]);
  }
  double farthest = 0;
  for (Point<3>& x : points) {
    x = difference(x, middle);
    farthest = std::max({farthest, std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
  }
  if constexpr (N == 3) {
    const Point<3> normal =
        cross(difference(points[1], points[0]), difference(points[2], points[0]));
    if (apart_along(normal, half, points, farthest)) return false;
  }
  for (std::size_t n = 0; n < (N == 3 ? N : 1); ++n) {
    const Point<3> edge = difference(points[(n + 1) % N], points[n]);
    for (const Point<3>& axis : {Point<3>{0, -edge[2], edge[1]}, Point<3>{edge[2], 0, -edge[0]},
                                 Point<3>{-edge[1], edge[0], 0}})
      if (apart_along(axis, half, points, farthest)) return false;
  }
  return true;
}

}  // namespace

// The derivative of the determinant by the shift is (q - p) x (b - a).
int side_of_line(const Point<3>& p, const Point<3>& q, const Point<3>& a, const Point<3>& b) {
  int side = orientation(p, q, a, b);
  for (int k = 0; k < 3 && side == 0; ++k)
    side = turn(along(k, p), along(k, q), along(k, a), along(k, b));
  return side;
}

bool may_touch(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  if (boxes_are_apart(p, q, triangle)) return false;  // Excludes most triangles.
  const auto& [a, b, c] = triangle;
  if (orientation(a, b, c, p) * orientation(a, b, c, q) > 0) return false;
  const std::initializer_list<int> sides{orientation(p, q, a, b), orientation(p, q, b, c),
                                         orientation(p, q, c, a)};
  if (!all_on_one_side(sides)) return false;
  if (std::any_of(sides.begin(), sides.end(), [](int side) { return side != 0; })) return true;
  for (int k = 0; k < 3; ++k) {  // All in one plane: the projections can be disjoint.
    const Point<2> from = along(k, p), to = along(k, q);
    const int beside = orientation(from, to, along(k, a));
    if (beside != 0 && beside == orientation(from, to, along(k, b)) &&
        beside == orientation(from, to, along(k, c)))
      return false;
  }
  return true;
}

// Requires x to lie in the plane of the triangle and in its projection along each axis. A
// projection to a segment excludes no more than its bounding box.
bool on_facet(const FacetCorners<3>& triangle, const Point<3>& x) {
  if (boxes_are_apart(x, x, triangle)) return false;  // Excludes most points.
  const auto& [a, b, c] = triangle;
  if (orientation(a, b, c, x) != 0) return false;
  for (int k = 0; k < 3; ++k) {
    const Point<2> at = along(k, x), u = along(k, a), v = along(k, b), w = along(k, c);
    if (!all_on_one_side({orientation(u, v, at), orientation(v, w, at), orientation(w, u, at)}))
      return false;
  }
  return true;
}

bool may_meet_box(const FacetCorners<3>& triangle, const Box<3>& box) {
  return hull_may_meet_box(triangle, box);
}

bool segment_may_meet_box(const Point<3>& a, const Point<3>& b, const Box<3>& box) {
  return hull_may_meet_box(std::array{a, b}, box);
}

// Returns the projection of x onto the plane of the triangle if it lies in the triangle, otherwise
// the nearest point of the edges.
TrianglePoint nearest_triangle_point(const FacetCorners<3>& triangle, const Point<3>& x) {
  const auto& [a, b, c] = triangle;
  const Point<3> ab = difference(b, a), ac = difference(c, a), ax = difference(x, a);
  const Point<3> normal = cross(ab, ac);
  const double square = dot(normal, normal);
  const double t = dot(cross(ax, ac), normal), u = dot(cross(ab, ax), normal);
  if (t > 0 && u > 0 && t + u < square) {
    const double v = t / square, w = u / square;
    return {
        {a[0] + v * ab[0] + w * ac[0], a[1] + v * ab[1] + w * ac[1], a[2] + v * ab[2] + w * ac[2]},
        {v, w}};
  }
  const SegmentPoint on_ab = nearest_on_segment(a, b, x), on_bc = nearest_on_segment(b, c, x),
                     on_ac = nearest_on_segment(a, c, x);
  TrianglePoint nearest{on_ab.x, {on_ab.along, 0}};
  for (const TrianglePoint& other : {TrianglePoint{on_bc.x, {1 - on_bc.along, on_bc.along}},
                                     TrianglePoint{on_ac.x, {0, on_ac.along}}})
    if (squared_distance<3>(other.x, x) < squared_distance<3>(nearest.x, x)) nearest = other;
  return nearest;
}

}  // namespace pnpbs
