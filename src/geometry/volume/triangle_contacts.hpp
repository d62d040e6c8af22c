// SPDX-License-Identifier: BSD-3-Clause
// Exact tests whether triangles and segments in space intersect. Triangles must have an area.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Returns whether the closed segment pq and the closed triangle intersect.
bool segment_meets(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

// Returns whether the segment from corner 0 of the triangle to q and the triangle have more than
// that corner in common.
bool segment_runs_into(const Point<3>& q, const FacetCorners<3>& triangle);

// Returns whether two triangles have more in common than their common corners and the edge between
// these. `vertices_a` and `vertices_b` number the corners; common corners have equal numbers. At
// most two corners may be common.
bool triangles_meet(const FacetCorners<3>& a, const std::array<std::int32_t, 3>& vertices_a,
                    const FacetCorners<3>& b, const std::array<std::int32_t, 3>& vertices_b);

using SegmentEnds = std::array<Point<3>, 2>;
Point<3> nearest_on_segment(const SegmentEnds& segment, const Point<3>& x);
// Returns a point of s that is nearest to t, rounded.
Point<3> nearest_to_segment(const SegmentEnds& s, const SegmentEnds& t);

// How two triangles intersect, and a point of the intersection, rounded.
struct Contact {
  enum class Kind { cross, touch, overlap } kind;
  Point<3> place;
};
Contact contact_of(const FacetCorners<3>& a, const FacetCorners<3>& b);

// Returns a point of the intersection of a segment and a triangle, rounded.
Point<3> meeting_point(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

}  // namespace pnpbs
