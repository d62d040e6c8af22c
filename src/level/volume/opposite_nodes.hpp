// SPDX-License-Identifier: BSD-3-Clause
// Opposite nodes on walls much thinner than d and in gaps much narrower. Tetrahedra that connect
// the two sides of a wall have circumspheres of a radius near d only if the nodes of the two sides
// lie opposite each other. If they are s apart along a wall of thickness t, the radius is about
// d s/t, and such tetrahedra are no elements (delaunay/volume/element_rule.hpp). Therefore one side
// gets the nodes of the other. The same is done across gaps, where the nodes of one side would lie
// in the circumspheres of the triangles of the other and tetrahedra would cross the surfaces, and
// in stacks of several sheets.
#pragma once

#include <vector>

#include "level/level.hpp"
#include "level/population_events.hpp"

namespace pnpbs {

// Moves the nodes on one of several close sheets of the surfaces straight through to the other
// sheets, where they replace the nodes. Nodes on feature edges are kept. The nodes must be at rest
// on the surfaces, and surface nodes must be those that move. Returns counts over all ranks. All
// ranks must call it, and if one rank throws, all ranks throw.
PopulationCounts place_opposite_nodes(Level<3>& level);

// Returns how far a node at that point of a surface may move along it in one step of the sliver
// repair. Where another sheet is at a distance t below kThinWall d, the node must stay opposite its
// partner and moves by a fraction of t^2/d only; elsewhere the result is infinite. Local.
double room_on_thin_wall(const Level<3>& level, const SurfacePoint& at, double d);

// Returns whether a tetrahedron with this centroid connects the two sides of such a wall. d is the
// smallest spacing of its corners. Local.
bool connects_thin_wall(const Level<3>& level, const Point<3>& centroid, double d);

}  // namespace pnpbs
