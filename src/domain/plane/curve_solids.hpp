// SPDX-License-Identifier: BSD-3-Clause
// The solids that the curves of a plane domain describe, and which of them contain each of the
// faces into which the curves divide the plane once they are split where they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/plane/curve_source.hpp"
#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/faces.hpp"

namespace pnpbs {

// The solids of curves before they are split. A solid contains what its curves enclose.
//
// Each loop of boundary curves is a solid, which is a closed curve or open curves that are joined
// at their ends. A loop is a cavity of the last solid before it if this encloses it and runs around
// in the other direction. The other boundary curves form one solid together. In a graph each group
// of segments with one tag that is closed is a solid if there are several groups. If others exist,
// the remaining parts of what the graph encloses form a further solid.
class CurveSolids {
 public:
  // `graph` is that of the sources before they are split.
  CurveSolids(const std::vector<CurveSource>& sources, const DomainGraph& graph);

  std::int32_t count() const { return static_cast<std::int32_t>(solids_.size()); }
  // Returns the solids that contain each face, in increasing order. `graph` is that of the faces.
  std::vector<std::vector<std::int32_t>> around(const DomainGraph& graph, const Faces& faces) const;

 private:
  using Polygon = std::vector<Point<2>>;

  struct Solid {
    std::int32_t outline;                // a ring; it contains what this encloses
    std::vector<std::int32_t> cavities;  // except what these rings enclose
    std::int32_t graph = -1;             // its source if that is a graph
    bool is_rest = false;                // whether the other solids of the graph are no part of it
  };
  // The rings that segments of a source belong to, -1 if none.
  struct RingsOfSource {
    std::vector<std::int32_t> of_segments;  // empty if none belongs to a ring of its own
    std::int32_t of_all = -1;
  };

  void add_loops(const std::vector<CurveSource>& sources, const DomainGraph& graph);
  void add_loop(const std::vector<std::int32_t>& of_sources, const Polygon& polygon);
  void add_graph(const CurveSource& source, std::int32_t number);
  std::int32_t add_solid();
  std::vector<std::vector<std::int32_t>> rings_at_edges(const DomainGraph& graph) const;

  std::vector<RingsOfSource> rings_;
  std::int32_t ring_count_ = 0;
  std::vector<Solid> solids_;
  Polygon last_polygon_;  // of the last loop that is no cavity
};

}  // namespace pnpbs
