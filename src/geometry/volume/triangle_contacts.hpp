// SPDX-License-Identifier: BSD-3-Clause
// Where triangles and segments in space meet, decided exactly. Triangles have an area.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Have the closed segment pq and the closed triangle a point in common?
bool segment_meets(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

// A segment from the triangle's corner 0 to q: have they more in common than that corner?
bool segment_runs_into(const Point<3>& q, const FacetCorners<3>& triangle);

// Triangles by their corners and by numbers of these, of which some are the same: have they more in
// common than these corners and the edge between them? Not for three.
bool triangles_meet(const FacetCorners<3>& a, const std::array<std::int32_t, 3>& vertices_a,
                    const FacetCorners<3>& b, const std::array<std::int32_t, 3>& vertices_b);

using SegmentEnds = std::array<Point<3>, 2>;
Point<3> nearest_on_segment(const SegmentEnds& segment, const Point<3>& x);
// A point of the first segment that is nearest to the second (rounded).
Point<3> nearest_to_segment(const SegmentEnds& s, const SegmentEnds& t);

// Of two triangles that meet: how, and a point where they do (rounded).
struct Contact {
  enum class Kind { cross, touch, overlap } kind;
  Point<3> place;
};
Contact contact_of(const FacetCorners<3>& a, const FacetCorners<3>& b);

// Of a segment and a triangle that meet a point where they do (rounded).
Point<3> meeting_point(const Point<3>& p, const Point<3>& q, const FacetCorners<3>& triangle);

}  // namespace pnpbs
