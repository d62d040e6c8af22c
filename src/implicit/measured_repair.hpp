// SPDX-License-Identifier: BSD-3-Clause
// Measures the distances between a repaired body and the triangles it was made from.
#pragma once

#include "geometry/volume/nearest_triangles.hpp"
#include "implicit/repair_distances.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

RepairDistances distances_of_repair(const NearestTriangles& given, const SurfaceSource& made,
                                    double resolution);

}  // namespace pnpbs
