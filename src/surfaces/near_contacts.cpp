// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/near_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

constexpr double kNormalRounding = 32 * std::numeric_limits<double>::epsilon();

bool contains(const std::array<std::int32_t, 3>& corners, std::int32_t v) {
  return v == corners[0] || v == corners[1] || v == corners[2];
}

// Returns the distance of x from a segment, or infinity if it is certainly larger than the reach.
double distance_within(double reach, const Point<3>& a, const Point<3>& b, const Point<3>& x) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax(a[k], b[k]);
    if (x[k] < low - reach || x[k] > high + reach) return HUGE_VAL;
  }
  return distance<3>(nearest_on_segment({a, b}, x), x);
}

}  // namespace

// Returns the side of the plane of q on which each vertex of p lies, 0 for vertices within the
// reach of the plane. The normal of a thin triangle has a large rounding error, which the margin
// covers.
NearContactSearch::Sides NearContactSearch::sides_of(const Corners& p, const Corners& q) const {
  const Point<3>& origin = at(q[0]);
  const Point<3> u = difference(at(q[1]), origin), v = difference(at(q[2]), origin);
  const Point<3> normal = cross(u, v);
  const double twice_area = length(normal);
  const double squares = dot(u, u) + dot(v, v);
  Sides sides;
  int least = 1, most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (contains(q, p[i])) continue;
    const Point<3> x = difference(at(p[i]), origin);
    const double height = dot(normal, x);
    const double margin =
        reach_ * twice_area +
        kNormalRounding * squares * (std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2]));
    sides.of[i] = height > margin ? 1 : height < -margin ? -1 : 0;
    least = std::min(least, sides.of[i]);
    most = std::max(most, sides.of[i]);
  }
  sides.apart = least > 0 || most < 0;
  return sides;
}

// Returns whether two triangles with a common edge lie on different sides of it.
bool NearContactSearch::lie_beside(const Corners& p, const Corners& q) const {
  std::array<std::int32_t, 2> common{};
  int count = 0;
  std::int32_t apex_p = -1, apex_q = -1;
  for (const std::int32_t v : p) {
    if (!contains(q, v)) {
      apex_p = v;
    } else if (count < 2) {
      common[static_cast<std::size_t>(count++)] = v;
    }
  }
  for (const std::int32_t v : q)
    if (!contains(p, v)) apex_q = v;
  if (count != 2 || apex_p < 0 || apex_q < 0) return false;
  const Point<3> along = unit_vector(difference(at(common[1]), at(common[0])));
  const Point<3> to_p = part_across(difference(at(apex_p), at(common[0])), along);
  const Point<3> to_q = part_across(difference(at(apex_q), at(common[0])), along);
  return dot(to_p, to_q) < 0;
}

NearContactSearch::Location NearContactSearch::locate(std::int32_t v,
                                                      const Corners& triangle) const {
  using enum Location::Kind;
  for (int k = 0; k < 3; ++k)
    if (triangle[static_cast<std::size_t>(k)] == v) return {corner, k};
  const Point<3>& x = at(v);
  const FacetCorners<3> corners{at(triangle[0]), at(triangle[1]), at(triangle[2])};
  Box<3> box = empty_box<3>();
  for (const Point<3>& y : corners) include(box, y);
  if (!in_closed_box(widened(box, reach_), x)) return {};
  double nearest = reach_;
  Location location;
  for (int k = 0; k < 3; ++k) {
    const Point<3>&a = corners[static_cast<std::size_t>(k)],
          &b = corners[static_cast<std::size_t>((k + 1) % 3)];
    const double gap = distance_within(reach_, a, b, x);
    if (gap > nearest) continue;
    nearest = gap;
    location = {edge, k};
  }
  if (location.kind == edge) return location;
  return distance<3>(nearest_on(corners, x), x) <= reach_ ? Location{inside, 0} : Location{};
}

// Returns whether a vertex lies on the edge from corner k of a triangle to the next.
bool NearContactSearch::on_edge(const Location& x, int k) {
  using enum Location::Kind;
  return (x.kind == edge && x.k == k) || (x.kind == corner && (x.k == k || x.k == (k + 1) % 3));
}

// Adds the vertices and edges of q on p.
void NearContactSearch::add_on(std::int32_t p, const Corners& corners_p, const Corners& corners_q,
                               const Sides& sides_q) {
  using enum Location::Kind;
  std::array<Location, 3> locations;
  for (std::size_t i = 0; i < 3; ++i) {
    if (sides_q.of[i] != 0) continue;
    const std::int32_t v = corners_q[i];
    locations[i] = locate(v, corners_p);
    const auto& [kind, k] = locations[i];
    const auto start = static_cast<std::size_t>(k);
    if (kind == edge)
      contacts_.on_edges.emplace_back(edge_between(corners_p[start], corners_p[(start + 1) % 3]),
                                      v);
    if (kind == inside) contacts_.on_triangles.push_back({p, {v, v}});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Location &a = locations[i], &b = locations[(i + 1) % 3];
    if (a.kind == off || b.kind == off) continue;
    if (on_edge(a, 0) && on_edge(b, 0)) continue;
    if (on_edge(a, 1) && on_edge(b, 1)) continue;
    if (on_edge(a, 2) && on_edge(b, 2)) continue;
    contacts_.on_triangles.push_back({p, edge_between(corners_q[i], corners_q[(i + 1) % 3])});
  }
}

// Returns true only if two edges, or the lines through them, are farther from each other than the
// reach.
bool NearContactSearch::are_apart(const Edge& e, const Edge& f) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low_e, high_e] = std::minmax(at(e[0])[k], at(e[1])[k]);
    const auto [low_f, high_f] = std::minmax(at(f[0])[k], at(f[1])[k]);
    if (low_e > high_f + reach_ || low_f > high_e + reach_) return true;
  }
  const Point<3> u = difference(at(e[1]), at(e[0])), v = difference(at(f[1]), at(f[0])),
                 w = difference(at(f[0]), at(e[0]));
  const Point<3> normal = cross(u, v);
  const double height = std::fabs(dot(normal, w));
  const double rounding = kNormalRounding * length(u) * length(v) * length(w);
  return height > rounding + reach_ * (length(normal) + kNormalRounding * length(u) * length(v));
}

// Adds the edges of p and q that cross each other. An edge whose ends lie on the same side of the
// other triangle crosses none.
void NearContactSearch::add_crossings(const Corners& p, const Sides& sides_p, const Corners& q,
                                      const Sides& sides_q) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (sides_p.same(i)) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      if (sides_q.same(j)) continue;
      add_crossing(edge_between(p[i], p[(i + 1) % 3]), edge_between(q[j], q[(j + 1) % 3]));
    }
  }
}

bool NearContactSearch::is_near(const Edge& segment, std::int32_t v) const {
  return distance_within(reach_, at(segment[0]), at(segment[1]), at(v)) <= reach_;
}

// Adds two edges if they cross each other and no end lies on the other one.
void NearContactSearch::add_crossing(const Edge& e, const Edge& f) {
  if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return;
  if (are_apart(e, f)) return;
  if (is_near(e, f[0]) || is_near(e, f[1]) || is_near(f, e[0]) || is_near(f, e[1])) return;
  const SegmentEnds s{at(e[0]), at(e[1])}, t{at(f[0]), at(f[1])};
  if (distance_within(reach_, t[0], t[1], nearest_to_segment(s, t)) > reach_) return;
  contacts_.crossings.push_back(e < f ? std::array{e, f} : std::array{f, e});
}

bool NearContactSearch::add_contacts(std::int32_t p, const Corners& corners_p, std::int32_t q,
                                     const Corners& corners_q) {
  const Sides sides_p = sides_of(corners_p, corners_q);
  if (sides_p.apart) return false;
  const Sides sides_q = sides_of(corners_q, corners_p);
  if (sides_q.apart || lie_beside(corners_p, corners_q)) return false;
  const std::size_t before = contacts_.count();
  add_on(p, corners_p, corners_q, sides_q);
  add_on(q, corners_q, corners_p, sides_p);
  add_crossings(corners_p, sides_p, corners_q, sides_q);
  if (contacts_.count() > before && (sides_p.in_plane() || sides_q.in_plane()))
    contacts_.in_plane.push_back({p, q});
  return true;
}

bool NearContactSearch::add_contacts(std::int32_t p, const Corners& corners_p,
                                     const Edge& segment) {
  using enum Location::Kind;
  const bool is_point = segment[0] == segment[1];
  // The point that repeats an end makes the segment a triangle.
  const Sides sides = sides_of({segment[0], segment[1], segment[1]}, corners_p);
  if (sides.apart) return false;
  if (contains(corners_p, segment[0]) && contains(corners_p, segment[1])) return false;
  std::array<Location, 2> locations;
  for (std::size_t i = 0; i < (is_point ? 1 : 2); ++i) {
    if (sides.of[i] != 0) continue;
    locations[i] = locate(segment[i], corners_p);
    const auto& [kind, k] = locations[i];
    const auto start = static_cast<std::size_t>(k);
    if (kind == edge)
      contacts_.on_edges.emplace_back(edge_between(corners_p[start], corners_p[(start + 1) % 3]),
                                      segment[i]);
    if (kind == inside) contacts_.on_triangles.push_back({p, {segment[i], segment[i]}});
  }
  if (is_point) return false;
  for (const std::int32_t v : corners_p)
    if (v != segment[0] && v != segment[1] && is_near(segment, v))
      contacts_.on_edges.emplace_back(segment, v);
  for (std::size_t i = 0; i < 3; ++i)
    add_crossing(edge_between(corners_p[i], corners_p[(i + 1) % 3]), segment);
  const Location &a = locations[0], &b = locations[1];
  const bool along_one_edge = [&] {
    for (int k = 0; k < 3; ++k)
      if (on_edge(a, k) && on_edge(b, k)) return true;
    return false;
  }();
  if (a.kind != off && b.kind != off && !along_one_edge)
    contacts_.on_triangles.push_back({p, segment});
  return a.kind == off && b.kind == off;
}

void NearContactSearch::add_contacts(const Edge& s, const Edge& t) {
  for (const auto& [segment, other] : {std::pair{s, t}, std::pair{t, s}}) {
    if (segment[0] == segment[1]) continue;
    for (const std::int32_t v : other)
      if (v != segment[0] && v != segment[1] && is_near(segment, v))
        contacts_.on_edges.emplace_back(segment, v);
  }
  if (s[0] != s[1] && t[0] != t[1]) add_crossing(s, t);
}

}  // namespace pnpbs
