// SPDX-License-Identifier: BSD-3-Clause
// The stars of the plane after nodes have moved a little. They are still a triangulation where no
// triangle has turned over, as the boundary stays: it covers the domain once. And it is the one
// that would be found anew if each edge but those of the boundary is locally Delaunay, which takes
// far less to see than to find stars; where an edge is not, it is flipped (Lawson).
#pragma once

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "geometry/plane/incident_sectors.hpp"

namespace pnpbs {

// False if that cannot be done, or would not pay: then the stars are to be found anew. Of nodes
// that are all owned; stars are those of all of them.
bool restore_by_flips(const Nodes<2>& nodes, const IncidentSectors& sectors, DelaunayStars& stars);

}  // namespace pnpbs
