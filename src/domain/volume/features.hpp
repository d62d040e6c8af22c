// SPDX-License-Identifier: BSD-3-Clause
// The features of triangulated surfaces: sharp edges and what they divide. An edge is a feature
// where the normals on its two sides turn by more than an angle, where tags meet, where other than
// two triangles meet, and at a border. A corner is where other than two feature edges meet, or
// where they turn sharply. What lies between feature edges is a patch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "domain/boundary_mesh.hpp"

namespace pnpbs {

// Feature edges in a row, from corner to corner, or closed and without a corner.
struct FeatureCurve {
  std::vector<std::int32_t> nodes;   // of the mesh; of a closed one the first is also the last
  std::vector<std::int32_t> facets;  // of each edge, one that has it
  std::int32_t tag;

  bool closed() const { return nodes.front() == nodes.back(); }
};

struct Features {
  // Across edge k of a facet, from its corner k to the next one, lies this facet; -1 at a feature.
  std::vector<std::array<std::int32_t, 3>> across;
  std::vector<std::int32_t> patch;  // of each facet
  std::int32_t patches = 0;
  std::vector<FeatureCurve> curves;
  std::vector<std::int32_t> corners;  // nodes of the mesh, in their order
  // Patches that meet in a node of the mesh which lies on features, ascending; else empty.
  std::vector<std::vector<std::int32_t>> patches_at;
};

// Angles in degrees.
Features find_features(const BoundaryMesh<3>& mesh, double feature_angle);

}  // namespace pnpbs
