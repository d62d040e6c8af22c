// SPDX-License-Identifier: BSD-3-Clause
// Polylines inside a volume, and where they may meet its surfaces and each other: in common
// vertices, and along whole edges of triangles.
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
  std::string name;  // for messages: "polyline 0"
  bool closed;
  std::vector<Point<3>> points;
  std::vector<std::int32_t> tags;  // of the segments
};

struct CurveSegment {
  std::array<std::int32_t, 2> ends;  // vertices
  std::int32_t tag;
  std::string name;         // for messages: "segment 3 of polyline 0"
  std::int32_t along = -1;  // a triangle that has it as an edge
};

// vertex_of tells for each point, in the order given, which vertex it is. Throws
// Error(ErrorKind::domain) if a segment has no length.
std::vector<CurveSegment> make_segments(const std::vector<InnerPolyline>& polylines,
                                        const std::vector<std::int32_t>& vertex_of,
                                        const std::vector<Point<3>>& vertices);

// The boxes of all segments.
BoxTree<3> tree_of(const std::vector<CurveSegment>& segments,
                   const std::vector<Point<3>>& vertices);

// Finds what segments run along, and throws Error(ErrorKind::domain) where they meet a triangle or
// each other otherwise. What is closer than `same_place` meets.
void check_segments(std::vector<CurveSegment>& segments, const Triangulation& surface,
                    const BoxTree<3>& tree, double same_place);

}  // namespace pnpbs
