// SPDX-License-Identifier: BSD-3-Clause
// Which boundary nodes see which. Neither they nor the edges move, so it is found once per level.
// Where the boundary is fine for d these are most of the pairs that edges may separate.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "neighbors/near_edges.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

class BoundaryVisibility {
 public:
  // A new boundary of so many nodes.
  void reset(std::size_t boundary_nodes);

  // Finds what the boundary nodes among these see within the radius of near_edges, times their d,
  // unless that is known.
  void look(const Nodes<2>& nodes, const NearEdges& near_edges, const SizedTree<2>& map,
            const IncidentSectors& sectors);

  // Does boundary node b, one of those, see the boundary node c that near?
  bool sees(std::int32_t b, std::int32_t c) const;

 private:
  void look_from(const Nodes<2>& nodes, std::int64_t i, const NearEdges& near_edges,
                 const SizedTree<2>& map, const IncidentSectors& sectors);

  std::vector<std::vector<std::int32_t>> seen_;  // from each boundary node, sorted
  std::vector<double> reach_;                    // how far; 0: nothing is known
};

// Who sees whom among the nodes, as lists ask.
struct VisibilityPastEdges {
  const Nodes<2>& nodes;
  const NearEdges& near_edges;
  const BoundaryVisibility& boundary_visibility;
  const SizedTree<2>& map;
  const IncidentSectors& sectors;

  bool may_occlude(std::int64_t i) const { return near_edges.any(i); }

  // Does no boundary edge separate nodes i and j? For pairs within radius * (d_i + d_j) / 2. Nor
  // may they be far apart along a sphere.
  bool visible(std::int64_t i, std::int64_t j) const {
    if (map.boundary().embedding.is_sphere() && far_along_sphere(i, j)) return false;
    // Whatever lies between the two is within their distance of either, and that is at most
    // radius times the larger spacing.
    const bool i_wide = nodes.d(i) >= nodes.d(j);
    const std::int64_t wide = i_wide ? i : j;
    // Which of the first two holds cannot be guessed, that one does can: both are tested.
    const bool surely = !near_edges.any(wide) | near_edges.surely_visible(i, j);
    return surely || sees_past_edges(wide, i_wide ? j : i);
  }

  bool sees_past_edges(std::int64_t wide, std::int64_t other) const;
  bool far_along_sphere(std::int64_t i, std::int64_t j) const;
};

}  // namespace pnpbs
