// SPDX-License-Identifier: BSD-3-Clause
// Splits triangles where they meet, so that surfaces that cross, touch or lie on each other become
// one triangulation.
#pragma once

#include <cstdint>
#include <vector>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// A triangle on which another one lies.
struct CoveredTriangle {
  std::int32_t triangle;    // index of the triangle that stays
  SurfaceTriangle covered;  // its vertices have the order of the given triangle
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

// Splits triangles where they meet other than in common vertices and edges. Triangles that lie on
// each other become one, which comes from the first of them; `covered` lists the others. Pieces
// keep the attributes of the triangle that they are part of.
//
// Vertices closer than a tolerance are merged, pieces thinner than it are removed, and a vertex
// closer than a sixteenth of it to an edge or a triangle lies on that: surfaces that coincide up to
// rounding become one. All other decisions are exact, and each new vertex has the coordinates
// nearest to the point. Crossings that arise when it is rounded are split again; throws
// Error(ErrorKind::domain) if some remain. The tolerance is larger than the given one where the
// coordinates have fewer digits: far from the origin, and if those of a source are of single
// precision.
//
// Nothing changes if triangles would have to be split at other points than `split_at` allows. The
// contacts include points at which edges cross, so that surfaces that cross in such points only are
// split as well.
//
// The vertices of triangles must be welded and the triangles must have an area. New vertices follow
// the given ones. The result does not depend on the number of threads. Takes O(n log n) time if
// triangles meet few others.
ArrangementSummary arrange(Triangulation& surface, double tolerance, SplitAt split_at,
                           std::vector<CoveredTriangle>& covered);

}  // namespace pnpbs
