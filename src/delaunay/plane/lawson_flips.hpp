// SPDX-License-Identifier: BSD-3-Clause
// Restores the stars of the plane after small movements of the nodes. As the boundary does not
// move, the stars are still a triangulation if no triangle has turned over. It is the Delaunay
// triangulation if every edge off the boundary is locally Delaunay, which is much faster to check
// than finding stars. Edges that are not are flipped (Lawson).
#pragma once

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "geometry/plane/incident_sectors.hpp"

namespace pnpbs {

// Restores the stars. Returns false if that is impossible or too slow; then they must be built
// again. All nodes must be owned, and all must have a star.
bool restore_by_flips(const Nodes<2>& nodes, const IncidentSectors& sectors, DelaunayStars& stars);

}  // namespace pnpbs
