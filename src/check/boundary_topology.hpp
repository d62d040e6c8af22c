// SPDX-License-Identifier: BSD-3-Clause
// Is the boundary of the tetrahedra a surface like that of the domain?
#pragma once

#include <cstdint>
#include <vector>

#include "level/found_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

struct BoundaryTopology {
  // Nodes where it is torn: around those on surfaces that bound the domain, the faces are not one
  // disk; or they are from inside and have faces.
  FoundNodes<3> torn;
  bool torn_on_surfaces = false;  // is one of them on a surface?
  // Euler's characteristic, vertices less edges plus triangles: of the boundary and of the domain's
  // surfaces. Where nothing is torn they differ by 2 for each handle or hole, and each piece.
  std::int64_t euler = 0, euler_of_domain = 0;
  std::int64_t pieces = 0, pieces_of_domain = 0;

  bool agrees() const {
    return torn.count == 0 && euler == euler_of_domain && pieces == pieces_of_domain;
  }
};

// Of a body, after prepare_stars. This rank's nodes where it is torn are added to `torn`, with
// their neighbours. Collective.
BoundaryTopology boundary_topology(const Results<3>& results, std::vector<Point<3>>& torn);

// Where a boundary that is torn nowhere may differ from the surfaces, of this rank: the nodes of
// its pieces that are too many (a bubble, say), or those with open faces that do not lie along the
// surfaces but go from one sheet of them to another, which may be right where they are rough.
// Whichever are fewer: what is too many where a neck is cut is a half of the body. Of a body, after
// prepare_stars. Collective.
std::vector<Point<3>> places_of_other_topology(const Level<3>& level);

}  // namespace pnpbs
