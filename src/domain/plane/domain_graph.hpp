// SPDX-License-Identifier: BSD-3-Clause
// Joins all curves of a domain into one planar graph. Points at the same position become one
// vertex, and segments are split at vertices that lie on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/plane_domain.hpp"
#include "geometry/plane/plane_sweep.hpp"

namespace pnpbs {

// A vertex of the graph.
struct GraphVertex {
  Point<2> position;
  std::int32_t source;  // source of the first point given there; -1: a fixed node
  std::int64_t index;   // index in that source
  std::int32_t fixed;   // fixed node at the vertex, or -1
  std::int32_t tag;     // tag given for the vertex, or 0
  std::int32_t degree;  // number of edges
  bool corner;
};

// A segment of a source or a part of one.
struct GraphEdge {
  std::int32_t source;
  std::int64_t segment;
  double t_begin, t_end;  // parameters, for smooth curves
};

// The joined graph. Vertices and edges are in the order given, with fixed nodes last.
struct DomainGraph {
  double size;  // longer side of the bounding box of all curves
  std::vector<GraphVertex> vertices;
  std::vector<GraphEdge> edges;
  std::vector<VertexPair> ends;  // vertices of each edge
};

// Returns the longer side of the bounding box of all curves.
double domain_size(const std::vector<CurveSource>& sources);

// Joins the sources. Throws Error(ErrorKind::domain) if points coincide that must not, such as two
// fixed nodes or two vertices of a graph.
DomainGraph join_sources(const std::vector<CurveSource>& sources,
                         const std::vector<FixedNode<2>>& fixed_nodes, double size);

// Returns the name of a vertex for messages.
std::string vertex_name(const GraphVertex& vertex, const std::vector<CurveSource>& sources,
                        const std::vector<FixedNode<2>>& fixed_nodes);

// Returns the angle between the directions before->at and at->after. [degrees]
double turn_in_degrees(const Point<2>& before, const Point<2>& at, const Point<2>& after);

// Finds the corners of a graph whose segments approximate smooth curves, and reorders the segments
// chain by chain from corner to corner. A vertex is a corner if the direction turns by more than
// `corner_angle` (degrees), if other than two segments end there, if their tags differ, or if it
// has a tag of its own. If `corner_angle` is 0, every vertex is a corner.
void find_corners(CurveSource& graph, double corner_angle);

}  // namespace pnpbs
