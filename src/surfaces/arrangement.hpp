// SPDX-License-Identifier: BSD-3-Clause
// Splits triangles where they meet, so that surfaces that cross, touch or lie on each other become
// one triangulation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// A triangle on which another one lies.
struct CoveredTriangle {
  std::int32_t triangle;    // index of the triangle that stays
  SurfaceTriangle covered;  // its vertices have the order of the given triangle
};

// A segment of a curve between vertices of a triangulation, or a point if both are equal.
struct ArrangedSegment {
  std::array<std::int32_t, 2> ends;
  std::int32_t number;  // of the given segment that it is a part of
};

struct ArrangementSummary {
  std::int64_t split = 0;         // given triangles that were split or removed
  std::int64_t new_vertices = 0;  // vertices at which no given one lies
  std::int64_t covered = 0;       // triangles that lay on another one
  int rounds = 0;                 // how often triangles were split
  double tolerance = 0;           // within which vertices were merged
};

// The points at which triangles may be split.
enum class SplitAt {
  any_point,
  contacts  // where vertices and edges lie on other triangles
};

// Distance within which a vertex lies on an edge or a triangle. [tolerance of vertices] Vertices on
// one triangle then have different projections to its plane.
inline constexpr double kContactReach = 0.0625;

struct ArrangementRule {
  double tolerance;  // within which the given vertices are welded
  SplitAt split_at = SplitAt::any_point;
  double gap = 0;  // surfaces this close to each other become one
};

// Splits triangles where they meet other than in common vertices and edges. Triangles that lie on
// each other become one, which comes from the first of them; `covered` lists the others. Pieces
// keep the attributes of the triangle that they are part of.
//
// Vertices closer than a tolerance are merged, pieces thinner than it are removed, and a vertex
// closer than a sixteenth of it to an edge or a triangle lies on that: surfaces that coincide up to
// rounding become one. All other decisions are exact, and each new vertex has the coordinates
// nearest to the point. Crossings that arise when it is rounded are split again; throws
// Error(ErrorKind::domain) if some remain. The tolerance is larger than that of `rule` where the
// coordinates have fewer digits: far from the origin, and if those of a source are of single
// precision. It is at least sixteen times the gap, so that surfaces within the gap coincide.
//
// Segments of curves are split where they meet triangles and each other, and triangles where
// segments and points meet them, so that these have common vertices, and segments on triangles are
// edges of them. The first of several segments that lie on each other stays.
//
// Nothing changes if triangles would have to be split at other points than `rule` allows. The
// contacts include points at which edges cross, so that surfaces that cross in such points only are
// split as well.
//
// The vertices of triangles must be welded and the triangles must have an area. New vertices follow
// the given ones. The result does not depend on the number of threads. Takes O(n log n) time if
// triangles meet few others.
ArrangementSummary arrange(Triangulation& surface, std::vector<ArrangedSegment>& curves,
                           const ArrangementRule& rule, std::vector<CoveredTriangle>& covered);

}  // namespace pnpbs
