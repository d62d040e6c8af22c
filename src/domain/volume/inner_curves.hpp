// SPDX-License-Identifier: BSD-3-Clause
// Polylines inside a volume, and the check that they meet surfaces and each other only in common
// vertices or along whole edges of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A polyline as it was added.
struct InnerPolyline {
  std::string name;  // for messages, such as "polyline 0"
  bool closed;
  std::vector<Point<3>> points;
  std::vector<std::int32_t> tags;  // one per segment
};

// A segment of a polyline between vertices of the triangulation.
struct CurveSegment {
  std::array<std::int32_t, 2> ends;  // vertices
  std::int32_t tag;
  std::string name;         // for messages, such as "segment 3 of polyline 0"
  std::int32_t along = -1;  // a triangle that has the segment as an edge, or -1
};

// Returns the segments of all polylines. `vertex_of` maps each of their points, in the order given,
// to a vertex. Throws Error(ErrorKind::domain) if a segment has no length.
std::vector<CurveSegment> make_segments(const std::vector<InnerPolyline>& polylines,
                                        const std::vector<std::int32_t>& vertex_of,
                                        const std::vector<Point<3>>& vertices);

// Builds a tree of the bounding boxes of all segments.
BoxTree<3> tree_of(const std::vector<CurveSegment>& segments,
                   const std::vector<Point<3>>& vertices);

// Sets `along` of each segment. Throws Error(ErrorKind::domain) if a segment meets a triangle or
// another segment except as allowed. Segments closer than `same_place` count as meeting.
void check_segments(std::vector<CurveSegment>& segments, const Triangulation& surface,
                    const BoxTree<3>& tree, double same_place);

}  // namespace pnpbs
