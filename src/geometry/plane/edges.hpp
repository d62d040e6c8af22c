// SPDX-License-Identifier: BSD-3-Clause
// The geometric operations on a facet in the plane, which is an edge.
#pragma once

#include <algorithm>

#include "geometry/boundary_mesh.hpp"
#include "geometry/boxes_apart.hpp"
#include "geometry/plane/segments.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

// Returns whether segment pq crosses the edge. A vertex exactly on the line pq counts as left of
// it, so that a segment through a vertex crosses a consistent number of its edges. The segment must
// not begin or end on the edge.
inline bool crosses(const Point<2>& p, const Point<2>& q, const FacetCorners<2>& edge) {
  const auto& [a, b] = edge;
  if ((orientation(p, q, a) >= 0) == (orientation(p, q, b) >= 0)) return false;
  return orientation(a, b, p) * orientation(a, b, q) < 0;
}

// Returns whether closed segment pq and the edge intersect. It can return true without an
// intersection if all points lie on a line, but never false with one.
inline bool may_touch(const Point<2>& p, const Point<2>& q, const FacetCorners<2>& edge) {
  const auto& [a, b] = edge;
  return orientation(a, b, p) * orientation(a, b, q) <= 0 &&
         orientation(p, q, a) * orientation(p, q, b) <= 0;
}

// Returns whether x lies exactly on the closed edge.
inline bool on_facet(const FacetCorners<2>& edge, const Point<2>& x) {
  const auto& [a, b] = edge;
  for (int k = 0; k < 2; ++k)
    if (x[k] < std::min(a[k], b[k]) || x[k] > std::max(a[k], b[k])) return false;
  return orientation(a, b, x) == 0;
}

inline bool may_meet_box(const FacetCorners<2>& edge, const Box<2>& box) {
  return segment_may_meet_box(edge[0], edge[1], box);
}

inline Point<2> nearest_on(const FacetCorners<2>& edge, const Point<2>& x) {
  return nearest_on_segment(edge[0], edge[1], x);
}

}  // namespace pnpbs
