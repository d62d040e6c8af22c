// SPDX-License-Identifier: BSD-3-Clause
// The features of triangulated surfaces: sharp edges and what they divide. An edge is a feature
// where the normals on its two sides turn by more than an angle, where tags meet, where other than
// two triangles meet, at a border, and where an inner curve runs. A corner is where other than two
// feature edges meet, where they turn sharply, and at a fixed node. What lies between feature edges
// is a patch. Short creases (short_creases.hpp) are no features.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Feature edges in a row, from corner to corner, or closed and without a corner. On either side of
// it lies the same patch all along.
struct FeatureCurve {
  std::vector<std::int32_t> nodes;  // of the mesh; of a closed one the first is also the last
  std::vector<std::vector<std::int32_t>> facets;  // of each edge, those that have it, ascending
  std::int32_t first_edge;  // feature edges are numbered along the curves, one after the other
  std::int32_t tag;         // of the inner curve there, or else of the first of all its facets

  bool closed() const { return nodes.front() == nodes.back(); }
  std::size_t edge_count() const { return facets.size(); }
};

// One of the two directions in which a curve runs; curve -1: none.
struct CurveDirection {
  std::int32_t curve = -1;
  bool forward = true;

  bool operator==(const CurveDirection&) const = default;
};

struct Features {
  // Across edge k of a facet, from its corner k to the next one, lies this facet; -1 at a feature.
  // (Facets that are no triangles, but parts of inner curves, have -1 all around.)
  std::vector<std::array<std::int32_t, 3>> across;
  std::vector<std::int32_t> patch;  // of each facet; -1 if it is no triangle
  std::int32_t patches = 0;
  std::vector<FeatureCurve> curves;
  std::vector<std::int32_t> corners;  // nodes of the mesh, in their order
  // Patches that meet in a node of the mesh which lies on features, ascending; else empty.
  std::vector<std::vector<std::int32_t>> patches_at;
  // Sharp edges that are no features, by their nodes.
  std::vector<std::array<std::int32_t, 2>> short_creases;

  bool is_corner(std::int32_t mesh_node) const;
};

// Surfaces between whose facets normals do not count.
struct SmoothSurfaces {
  std::vector<std::int32_t> of;  // of each facet its surface, or -1; empty if there are none
  std::vector<std::array<std::int32_t, 2>> creases;  // on them, by their nodes, both ascending
};

// Angles in degrees. What is found depends on the order of facets and nodes
// alone; the time taken is linear in their number, but for sorting short creases.
Features find_features(const BoundaryMesh<3>& mesh, double feature_angle,
                       const SmoothSurfaces& smooth = {});

// The unit normal of a facet; 0 if it has no area.
Point<3> facet_normal(const BoundaryMesh<3>& mesh, const BoundaryTriangle& facet);

}  // namespace pnpbs
