// SPDX-License-Identifier: BSD-3-Clause
// The boundary edges around each boundary node, counter-clockwise, and which of the sectors
// between them lie inside the domain.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

struct SectorEdge {
  std::int32_t other;  // boundary node at the far end
  std::int32_t edge;   // index of the edge
  bool inside_after;   // is the sector counter-clockwise of this edge inside?
};

class IncidentSectors {
 public:
  void build(const BoundaryMesh<2>& boundary);

  std::int32_t begin(std::int32_t node) const { return offset_[static_cast<std::size_t>(node)]; }
  std::int32_t end(std::int32_t node) const { return offset_[static_cast<std::size_t>(node) + 1]; }
  const SectorEdge& edge(std::int32_t k) const { return edges_[static_cast<std::size_t>(k)]; }

  bool joined(std::int32_t a, std::int32_t b) const;

  // Does the way from boundary node `node` towards x start inside the domain (or along an edge)?
  bool leads_inside(const BoundaryMesh<2>& boundary, std::int32_t node, const Point<2>& x) const;

  // May the straight way from x to y, on which the node lies exactly, go on past the node? Only if
  // both directions lie in one sector inside the domain, or along its edges.
  bool lets_pass(const BoundaryMesh<2>& boundary, std::int32_t node, const Point<2>& x,
                 const Point<2>& y) const;

 private:
  // The sector of a direction, named by the edge before it; two along an edge.
  struct Sectors {
    std::int32_t after, before;
  };
  Sectors sectors_towards(const BoundaryMesh<2>& boundary, std::int32_t node,
                          const Point<2>& x) const;

  std::vector<std::int32_t> offset_;
  std::vector<SectorEdge> edges_;
};

}  // namespace pnpbs
