// SPDX-License-Identifier: BSD-3-Clause
// The boundary edges around each boundary node in counter-clockwise order, and whether the sectors
// between them lie inside the domain.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

struct SectorEdge {
  std::int32_t other;  // Boundary node at the other end.
  std::int32_t edge;   // Index of the edge.
  bool inside_after;   // Whether the sector counter-clockwise of the edge is inside.
};

class IncidentSectors {
 public:
  void build(const BoundaryMesh<2>& boundary);

  std::int32_t begin(std::int32_t node) const { return offset_[static_cast<std::size_t>(node)]; }
  std::int32_t end(std::int32_t node) const { return offset_[static_cast<std::size_t>(node) + 1]; }
  const SectorEdge& edge(std::int32_t k) const { return edges_[static_cast<std::size_t>(k)]; }

  bool joined(std::int32_t a, std::int32_t b) const;

  // Returns whether the direction from boundary node `node` to x leads into the domain or along an
  // edge.
  bool leads_inside(const BoundaryMesh<2>& boundary, std::int32_t node, const Point<2>& x) const;

  // Returns whether the domain contains segment xy near the node, which lies exactly on the
  // segment. This requires that both directions lie in one sector inside the domain, or along its
  // edges.
  bool lets_pass(const BoundaryMesh<2>& boundary, std::int32_t node, const Point<2>& x,
                 const Point<2>& y) const;

 private:
  // The sector that contains a direction, given by the edge before it. A direction along an edge
  // lies in two sectors; otherwise both members are equal.
  struct Sectors {
    std::int32_t after, before;
  };
  Sectors sectors_towards(const BoundaryMesh<2>& boundary, std::int32_t node,
                          const Point<2>& x) const;

  std::vector<std::int32_t> offset_;
  std::vector<SectorEdge> edges_;
};

}  // namespace pnpbs
