// SPDX-License-Identifier: BSD-3-Clause
// Walls much thinner than d, and gaps much narrower. Tetrahedra that connect the two sides of a
// wall have circumspheres of a radius near d only if the nodes of one side lie opposite those of
// the other: if they are s apart along the wall, whose thickness is t, the radius is about d s / t,
// and tetrahedra that wide are no elements (delaunay/volume/element_rule.hpp). So one side gets the
// nodes of the other. Across a gap the nodes of one side would lie in the circumspheres of the
// triangles of the other, and tetrahedra would go through the surfaces. So they lie opposite each
// other there as well, and in stacks of several sheets.
#pragma once

#include <vector>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Where sheets of the surfaces are nearer to each other than kThinWall d, the nodes on one of them
// are moved straight through to the others, whose nodes they replace. Nodes on feature edges stay.
// The nodes of the level are at rest on its surfaces, on which they move. Returns counts over all
// ranks. Collective.
PopulationCounts place_opposite_nodes(Level<3>& level);

// Returns how far a node at that point of a surface may move along it in one step of the sliver
// repair. Where another sheet is at a distance t below kThinWall d, the node must stay opposite its
// partner and moves by a fraction of t^2/d only; elsewhere the result is infinite. Local.
double room_on_thin_wall(const Level<3>& level, const SurfacePoint& at, double d);

// Does a tetrahedron with its centroid here connect the two sides of such a wall? d is the spacing
// of its corners. Local.
bool connects_thin_wall(const Level<3>& level, const Point<3>& centroid, double d);

}  // namespace pnpbs
