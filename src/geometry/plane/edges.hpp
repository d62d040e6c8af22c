// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a facet, in the plane: an edge.
#pragma once

#include <algorithm>

#include "geometry/boundary_mesh.hpp"
#include "geometry/boxes_apart.hpp"
#include "geometry/plane/segments.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

// Does the way from p to q cross the edge? A vertex exactly on the line pq counts as lying to its
// left, so a way through a vertex crosses none or both or one of its edges as it should. Not where
// the way begins or ends on the edge.
inline bool crosses(const Point<2>& p, const Point<2>& q, const FacetCorners<2>& edge) {
  const auto& [a, b] = edge;
  if ((orientation(p, q, a) >= 0) == (orientation(p, q, b) >= 0)) return false;
  return orientation(a, b, p) * orientation(a, b, q) < 0;
}

// Has the way from p to q, its ends included, a point in common with the edge? Never says no where
// it has; where all lie on a line, yes.
inline bool may_touch(const Point<2>& p, const Point<2>& q, const FacetCorners<2>& edge) {
  const auto& [a, b] = edge;
  return orientation(a, b, p) * orientation(a, b, q) <= 0 &&
         orientation(p, q, a) * orientation(p, q, b) <= 0;
}

// Is x exactly on the edge, its ends included?
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
