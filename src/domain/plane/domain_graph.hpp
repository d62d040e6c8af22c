// SPDX-License-Identifier: BSD-3-Clause
// All curves of a domain joined into one planar graph: what lies at the same place is one vertex,
// and a segment on which a vertex lies is split there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/plane_domain.hpp"
#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

struct GraphVertex {
  Point<2> position;
  std::int32_t source;  // of the first point given there; -1: a fixed node
  std::int64_t index;   // in it
  std::int32_t fixed;   // the fixed node there, or -1
  std::int32_t tag;     // given for the vertex, or 0
  std::int32_t degree;  // number of edges
  bool corner;
};

// A segment of a source, or a part of it.
struct GraphEdge {
  std::int32_t source;
  std::int64_t segment;
  double t_begin, t_end;  // parameters, on smooth curves
};

struct DomainGraph {
  double size;
  std::vector<GraphVertex> vertices;  // in the order given, fixed nodes last
  std::vector<GraphEdge> edges;       // in the order given
  std::vector<VertexPair> ends;       // of the edges
};

// The longer side of the bounding box of all curves.
double domain_size(const std::vector<CurveSource>& sources);

// Throws Error(ErrorKind::domain) for points that must not coincide.
DomainGraph join_sources(const std::vector<CurveSource>& sources,
                         const std::vector<FixedNode<2>>& fixed_nodes, double size);

std::string vertex_name(const GraphVertex& vertex, const std::vector<CurveSource>& sources,
                        const std::vector<FixedNode<2>>& fixed_nodes);

// By how much the way turns at a point between two others, in degrees.
double turn_in_degrees(const Point<2>& before, const Point<2>& at, const Point<2>& after);

// Finds the corners of a graph that stands for smooth curves between them: where the direction
// turns by more than corner_angle (degrees), where not two segments end or segments of different
// tags do, and vertices with a tag of their own; and puts its segments in order, chain by chain
// from corner to corner. 0: every vertex is a corner.
void find_corners(CurveSource& graph, double corner_angle);

}  // namespace pnpbs
