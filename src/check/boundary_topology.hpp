// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the topology of the boundary of the tetrahedra with that of the domain.
#pragma once

#include <cstdint>
#include <vector>

#include "level/found_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Topological quantities of both boundaries. All counts are over all ranks.
struct BoundaryTopology {
  // Nodes at which the boundary is torn: nodes on bounding surfaces around which the faces do not
  // form one disk, and inner nodes with boundary faces.
  FoundNodes<3> torn;
  bool torn_on_surfaces = false;  // true if one of them is on a surface
  // Euler characteristic, vertices minus edges plus triangles, of the boundary and of the surfaces
  // of the domain. If nothing is torn, they differ by 2 for each surplus or missing handle, hole or
  // piece.
  std::int64_t euler = 0, euler_of_domain = 0;
  // Numbers of connected pieces.
  std::int64_t pieces = 0, pieces_of_domain = 0;

  bool agrees() const {
    return torn.count == 0 && euler == euler_of_domain && pieces == pieces_of_domain;
  }
};

// Computes the topology of a body. Positions of this rank's nodes at which the boundary is torn,
// and of their neighbours, are appended to `torn`. Requires prepare_stars(). Collective.
BoundaryTopology boundary_topology(const Results<3>& results, std::vector<Point<3>>& torn);

// Returns this rank's nodes at which the topology of an untorn boundary may differ from that of the
// surfaces. These are either the nodes of surplus pieces (such as a bubble), or the nodes with open
// faces that bridge two sheets of the surfaces instead of lying along one; such faces may be
// correct where the surfaces are rough. The smaller set is returned, since the surplus piece is
// half of the body if a neck is cut. Only bodies have such nodes. Requires prepare_stars().
// Collective.
std::vector<Point<3>> points_of_other_topology(const Level<3>& level);

}  // namespace pnpbs
