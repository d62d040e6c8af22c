// SPDX-License-Identifier: BSD-3-Clause
// Identifies sharp edges that are roughness and not features. On a scanned body noise makes single
// triangles stand out; nodes on their edges would be crowded.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// An edge that may be a feature.
struct FeatureEdgeCandidate {
  std::array<std::int32_t, 2> nodes;  // mesh nodes
  bool crease;                        // true if it is a feature only by the angle
};

// Returns for each edge 1 if it belongs to a short crease. Creases are short if they have fewer
// than six edges whose total length is less than a tenth of the mesh's extent. First drops short
// creases with a free end, the shortest first. Then drops those that are connected to no other
// feature. (A small ring that is the rim of something has other features beginning at it, because
// so few edges turn by more than 60 degrees at its nodes.)
std::vector<char> short_creases(const BoundaryMesh<3>& mesh,
                                std::span<const FeatureEdgeCandidate> edges);

}  // namespace pnpbs
