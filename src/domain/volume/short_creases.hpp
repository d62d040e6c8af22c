// SPDX-License-Identifier: BSD-3-Clause
// Which sharp edges are roughness, not features. On a scanned body some triangles stand out by
// noise; nodes on their edges would only be crowded there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

struct FeatureEdgeCandidate {
  std::array<std::int32_t, 2> nodes;  // of the mesh
  bool crease;                        // a feature by the angle alone
};

// Of each edge: is it part of a short crease? Creases are short if they have fewer than six edges,
// and together less length than a tenth of the mesh's extent. Short ones are dropped, first where
// they end freely, the shortest before longer ones; then those that nothing joins to any other
// feature. (So few edges in a ring turn by over 60 degrees at their nodes: if they were the rim of
// something, others would begin there.)
std::vector<char> short_creases(const BoundaryMesh<3>& mesh,
                                std::span<const FeatureEdgeCandidate> edges);

}  // namespace pnpbs
