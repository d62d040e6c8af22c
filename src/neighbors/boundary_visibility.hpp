// SPDX-License-Identifier: BSD-3-Clause
// Visibility between boundary nodes, which is computed once per level because neither they nor the
// edges move. Where the boundary is fine for d, these are most of the pairs that edges may
// separate.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "neighbors/near_edges.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// The boundary nodes that are visible from each boundary node.
class BoundaryVisibility {
 public:
  // Clears the results for a new boundary with this number of nodes.
  void reset(std::size_t boundary_nodes);

  // Computes what the boundary nodes among `nodes` see within near_edges.radius() * d, unless it is
  // known already.
  void look(const Nodes<2>& nodes, const NearEdges& near_edges, const SizedTree<2>& map,
            const IncidentSectors& sectors);

  // Returns true if boundary node c is visible from boundary node b. look() must have processed b,
  // and c must be within its radius.
  bool sees(std::int32_t b, std::int32_t c) const;

 private:
  void look_from(const Nodes<2>& nodes, std::int64_t i, const NearEdges& near_edges,
                 const SizedTree<2>& map, const IncidentSectors& sectors);

  std::vector<std::vector<std::int32_t>> seen_;  // by boundary node: visible ones, sorted
  std::vector<double> reach_;  // by boundary node: search radius; 0 if not computed
};

// The visibility of all nodes of a plane domain, as AdjacencyList::build requires it.
struct VisibilityPastEdges {
  const Nodes<2>& nodes;
  const NearEdges& near_edges;
  const BoundaryVisibility& boundary_visibility;
  const SizedTree<2>& map;
  const IncidentSectors& sectors;

  bool may_occlude(std::int64_t i) const { return near_edges.any(i); }

  // Returns true if no boundary edge separates nodes i and j and they are not far apart along a
  // sphere. The pair must be within radius * (d_i + d_j) / 2.
  bool visible(std::int64_t i, std::int64_t j) const {
    if (map.boundary().embedding.is_sphere() && far_along_sphere(i, j)) return false;
    // An edge between the two nodes is within their distance of either, and this distance is at
    // most radius times the larger spacing. The edges near the node with the larger spacing
    // therefore suffice.
    const bool i_wide = nodes.d(i) >= nodes.d(j);
    const std::int64_t wide = i_wide ? i : j;
    // The operator | evaluates both tests: it is unpredictable which of them is true, but mostly
    // one is.
    const bool surely = !near_edges.any(wide) | near_edges.surely_visible(i, j);
    return surely || sees_past_edges(wide, i_wide ? j : i);
  }

  bool sees_past_edges(std::int64_t wide, std::int64_t other) const;
  bool far_along_sphere(std::int64_t i, std::int64_t j) const;
};

}  // namespace pnpbs
