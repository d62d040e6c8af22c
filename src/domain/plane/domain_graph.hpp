// SPDX-License-Identifier: BSD-3-Clause
// Joins all curves of a domain into one planar graph. Points at the same position become one
// vertex, and segments are split at vertices that lie on them, among them points at which curves
// were found to cross.
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
  std::int32_t source;  // source of the first point given there; -1: a fixed node or a crossing
  std::int64_t index;   // index in that source, or of the fixed node or the crossing
  std::int32_t fixed;   // fixed node at the vertex, or -1
  std::int32_t tag;     // tag given for the vertex, or 0
  std::int32_t degree;  // number of edges
  bool corner;
  bool crossing = false;  // whether curves were found to cross there

  // Returns true if no point was given there.
  bool is_only_crossing() const { return source < 0 && fixed < 0; }
};

// A segment of a source or a part of one.
struct GraphEdge {
  std::int32_t source;
  std::int64_t segment;
  double t_begin, t_end;  // parameters, for smooth curves
};

// An edge that lay on another one and was united with it.
struct UnitedEdge {
  std::int32_t edge;  // the edge that stays
  GraphEdge united;
};

// The joined graph. Vertices and edges are in the order given, with fixed nodes and then crossings
// last.
struct DomainGraph {
  double size;  // longer side of the bounding box of all curves
  std::vector<GraphVertex> vertices;
  std::vector<GraphEdge> edges;
  std::vector<VertexPair> ends;  // vertices of each edge
  std::vector<UnitedEdge> united;
};

// The straight edges with the same ends that become one, the first of them.
enum class Unite { none, of_different_sources, all };

// Returns the longer side of the bounding box of all curves.
double domain_size(const std::vector<CurveSource>& sources);

// Joins the sources. `crossings` are points at which edges are split that lie within rounding of
// them. Throws Error(ErrorKind::domain) if points coincide that must not, such as two fixed nodes
// or two vertices of a graph.
DomainGraph join_sources(const std::vector<CurveSource>& sources,
                         const std::vector<FixedNode<2>>& fixed_nodes,
                         const std::vector<Point<2>>& crossings, Unite unite, double size);

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
