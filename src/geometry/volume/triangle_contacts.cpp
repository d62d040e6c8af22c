// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/triangle_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/space_vectors.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// Projects a point along axis k. The remaining coordinates are in cyclic order.
Point<2> shadow(int k, const Point<3>& x) { return {x[(k + 1) % 3], x[(k + 2) % 3]}; }

struct FlatTriangle {
  std::array<Point<2>, 3> corners;  // Counter-clockwise.
};

// Returns an axis along which the projection of the triangle has an area.
int shadow_axis(const FacetCorners<3>& triangle) {
  for (int k = 0; k < 2; ++k)
    if (orientation(shadow(k, triangle[0]), shadow(k, triangle[1]), shadow(k, triangle[2])) != 0)
      return k;
  return 2;
}

FlatTriangle flat(int k, const FacetCorners<3>& triangle) {
  FlatTriangle shadows{{shadow(k, triangle[0]), shadow(k, triangle[1]), shadow(k, triangle[2])}};
  auto& [a, b, c] = shadows.corners;
  if (orientation(a, b, c) < 0) std::swap(b, c);
  return shadows;
}

bool holds(const FlatTriangle& triangle, const Point<2>& x) {
  const auto& [a, b, c] = triangle.corners;
  return orientation(a, b, x) >= 0 && orientation(b, c, x) >= 0 && orientation(c, a, x) >= 0;
}

bool flat_segments_meet(const Point<2>& p, const Point<2>& q, const Point<2>& a,
                        const Point<2>& b) {
  const FacetCorners<2> edge{a, b};
  return !boxes_are_apart(p, q, edge) && may_touch(p, q, edge);
}

bool flat_segment_meets(const Point<2>& p, const Point<2>& q, const FlatTriangle& triangle) {
  if (holds(triangle, p)) return true;
  const auto& [a, b, c] = triangle.corners;
  return flat_segments_meet(p, q, a, b) || flat_segments_meet(p, q, b, c) ||
         flat_segments_meet(p, q, c, a);
}

bool on_one_side(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// Returns orientation(a, b, c, d). The frequent case of points in a plane across an axis is tested
// first.
int side_of_plane(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  for (int k = 0; k < 3; ++k)
    if (a[k] == b[k] && a[k] == c[k] && a[k] == d[k]) return 0;
  return orientation(a, b, c, d);
}

// Returns whether two triangles with the common edge ab lie in one plane with c and d on the same
// side of the edge.
bool folded_over(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  if (side_of_plane(a, b, c, d) != 0) return false;
  const int k = shadow_axis({a, b, c});
  const Point<2> u = shadow(k, a), v = shadow(k, b);
  return orientation(u, v, shadow(k, c)) == orientation(u, v, shadow(k, d));
}

// Returns whether a line through the common corner and along an edge of one triangle separates the
// two triangles in a projection. The test is fast and succeeds for most neighbours.
bool a_line_divides(const FacetCorners<3>& a, const FacetCorners<3>& b) {
  const Point<3> normal = cross(difference(a[1], a[0]), difference(a[2], a[0]));
  int k = 0;
  for (int other = 1; other < 3; ++other)
    if (std::fabs(normal[other]) > std::fabs(normal[k])) k = other;
  const Point<2> common = shadow(k, a[0]);
  const auto divides = [&](const Point<2>& along, const Point<2>& own, const Point<2>& x,
                           const Point<2>& y) {
    const int side = orientation(common, along, own);
    return side * orientation(common, along, x) < 0 && side * orientation(common, along, y) < 0;
  };
  const Point<2> u = shadow(k, a[1]), v = shadow(k, a[2]), x = shadow(k, b[1]), y = shadow(k, b[2]);
  return divides(u, v, x, y) || divides(v, u, x, y) || divides(x, y, u, v) || divides(y, x, u, v);
}

// Returns whether all corners of b that are not common lie strictly on one side of the plane of a.
bool plane_divides(const FacetCorners<3>& a, const FacetCorners<3>& b, int common) {
  int side = 0;
  for (int k = common; k < 3; ++k) {
    const int here = side_of_plane(a[0], a[1], a[2], b[k]);
    if (here == 0 || here == -side) return false;
    side = here;
  }
  return true;
}

// Moves common corners to the front, in the same order in both triangles. Returns their number.
int bring_common_first(FacetCorners<3>& a, std::array<std::int32_t, 3> vertices_a,
                       FacetCorners<3>& b, std::array<std::int32_t, 3> vertices_b) {
  int common = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = common; j < 3; ++j) {
      if (vertices_a[i] != vertices_b[j]) continue;
      std::swap(a[i], a[common]);
      std::swap(vertices_a[i], vertices_a[common]);
      std::swap(b[j], b[common]);
      std::swap(vertices_b[j], vertices_b[common]);
      ++common;
      break;
    }
  return common;
}

// Returns whether p and q lie strictly on different sides of the plane of the triangle.
bool ends_are_apart(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  return orientation(a, b, c, p) * orientation(a, b, c, q) < 0;
}

Point<3> crossing_point(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Point<3> normal = cross(difference(b, a), difference(c, a));
  const double from = std::fabs(dot(normal, difference(p, a)));
  const double to = std::fabs(dot(normal, difference(q, a)));
  return shifted(p, from + to > 0 ? from / (from + to) : 0.5, difference(q, p));
}

// Returns a corner of one triangle that lies on the other and is not a corner of it.
std::optional<Point<3>> corner_in_contact(const FacetCorners<3>& a, const FacetCorners<3>& b) {
  for (const auto& [own, other] : {std::pair(a, b), std::pair(b, a)})
    for (const Point<3>& x : own)
      if (std::find(other.begin(), other.end(), x) == other.end() && on_facet(other, x)) return x;
  return {};
}

constexpr double kTouching = 1e-9;  // Largest gap due to rounding. [length of the edge]

// Returns a corner of only one triangle, or a point where edges without a common corner intersect;
// if there is neither, a common corner.
Point<3> contact_point(const FacetCorners<3>& a, const FacetCorners<3>& b) {
  if (const auto corner = corner_in_contact(a, b)) return *corner;
  const auto common = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  Point<3> place = common != a.end() ? *common : a[0];
  double least = common != a.end() ? kTouching : HUGE_VAL;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const SegmentEnds s{a[i], a[(i + 1) % 3]}, t{b[j], b[(j + 1) % 3]};
      if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) continue;
      const Point<3> x = nearest_to_segment(s, t);
      const double gap = distance<3>(x, nearest_on_segment(t, x));
      if (gap < least * distance<3>(s[0], s[1])) {
        place = x;
        least = gap / distance<3>(s[0], s[1]);
      }
    }
  return place;
}

}  // namespace

bool segment_meets(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  if (boxes_are_apart(p, q, triangle)) return false;
  const auto& [a, b, c] = triangle;
  const int side_p = side_of_plane(a, b, c, p), side_q = side_of_plane(a, b, c, q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    const int k = shadow_axis(triangle);
    return flat_segment_meets(shadow(k, p), shadow(k, q), flat(k, triangle));
  }
  return on_one_side(orientation(p, q, a, b), orientation(p, q, b, c), orientation(p, q, c, a));
}

bool segment_runs_into(const Point<3>& q, const FacetCorners<3>& triangle) {
  const auto& [a, b, c] = triangle;
  if (orientation(a, b, c, q) != 0) return false;
  const int k = shadow_axis(triangle);
  return holds(flat(k, triangle), shadow(k, q)) ||
         flat_segments_meet(shadow(k, a), shadow(k, q), shadow(k, b), shadow(k, c));
}

// The intersection of two triangles with a common corner is convex. If it is more than the corner,
// the opposite edge of one triangle meets the other triangle.
bool triangles_meet(const FacetCorners<3>& given_a, const std::array<std::int32_t, 3>& vertices_a,
                    const FacetCorners<3>& given_b, const std::array<std::int32_t, 3>& vertices_b) {
  FacetCorners<3> a = given_a, b = given_b;
  const int common = bring_common_first(a, vertices_a, b, vertices_b);
  if (common == 2) return folded_over(a[0], a[1], a[2], b[2]);
  if (common == 1 && a_line_divides(a, b)) return false;
  if (plane_divides(a, b, common) || plane_divides(b, a, common)) return false;
  if (common == 1) return segment_meets(a[1], a[2], b) || segment_meets(b[1], b[2], a);
  for (int k = 0; k < 3; ++k)
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a))
      return true;
  return false;
}

Point<3> nearest_on_segment(const SegmentEnds& segment, const Point<3>& x) {
  return nearest_on({segment[0], segment[1], segment[1]}, x);
}

// The candidates are the ends of both segments and, for lines that are not parallel, the point of s
// where the two lines are nearest.
Point<3> nearest_to_segment(const SegmentEnds& s, const SegmentEnds& t) {
  const auto gap = [&](const Point<3>& x) {
    return squared_distance<3>(x, nearest_on_segment(t, x));
  };
  Point<3> nearest = s[0];
  const auto offer = [&](const Point<3>& x) {
    if (gap(x) < gap(nearest)) nearest = x;
  };
  offer(s[1]);
  for (const Point<3>& end : t) offer(nearest_on_segment(s, end));
  const Point<3> u = difference(s[1], s[0]), v = difference(t[1], t[0]);
  const Point<3> normal = cross(u, v);
  const double square = dot(normal, normal);
  if (square > 0) {
    const double along = dot(cross(difference(t[0], s[0]), v), normal) / square;
    offer(shifted(s[0], std::clamp(along, 0.0, 1.0), u));
  }
  return nearest;
}

Contact contact_of(const FacetCorners<3>& a, const FacetCorners<3>& b) {
  for (const auto& [from, into] : {std::pair(a, b), std::pair(b, a)})
    for (int k = 0; k < 3; ++k) {
      const Point<3>&p = from[k], &q = from[(k + 1) % 3];
      if (ends_are_apart(p, q, into) && segment_meets(p, q, into))
        return {Contact::Kind::cross, crossing_point(p, q, into)};
    }
  const bool flat = std::all_of(
      b.begin(), b.end(), [&](const Point<3>& x) { return orientation(a[0], a[1], a[2], x) == 0; });
  return {flat ? Contact::Kind::overlap : Contact::Kind::touch, contact_point(a, b)};
}

Point<3> meeting_point(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle) {
  if (ends_are_apart(p, q, triangle)) return crossing_point(p, q, triangle);
  return contact_point({p, q, q}, triangle);
}

}  // namespace pnpbs
