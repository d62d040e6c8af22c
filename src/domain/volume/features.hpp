// SPDX-License-Identifier: BSD-3-Clause
// Finds the features of triangulated surfaces. An edge is a feature if the normals of its two
// triangles differ by more than an angle, if tags differ there, if it has other than two triangles,
// or if an inner curve runs along it. A corner is a node at which other than two feature edges meet
// or at which they turn sharply, or a fixed node. A patch is a part of the surface between feature
// edges. Short creases (short_creases.hpp) are not features.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// A chain of feature edges from corner to corner, or a closed one without corners. Each side has
// the same patch along the whole curve.
struct FeatureCurve {
  std::vector<std::int32_t> nodes;  // mesh nodes; a closed curve repeats the first at the end
  std::vector<std::vector<std::int32_t>> facets;  // facets at each edge, ascending
  std::int32_t first_edge;  // feature edges are numbered consecutively along the curves
  std::int32_t tag;         // tag of the inner curve, or else of the facet of lowest index

  bool closed() const { return nodes.front() == nodes.back(); }
  std::size_t edge_count() const { return facets.size(); }
};

// A curve with one of its two directions; curve -1 means none.
struct CurveDirection {
  std::int32_t curve = -1;
  bool forward = true;

  bool operator==(const CurveDirection&) const = default;
};

// All features of a mesh, and the patches between them.
struct Features {
  // The facet across edge k (from corner k to the next); -1 at a feature. Facets that are segments
  // of inner curves have -1 at all edges.
  std::vector<std::array<std::int32_t, 3>> across;
  std::vector<std::int32_t> patch;  // of each facet; -1 if it is not a triangle
  std::int32_t patches = 0;
  std::vector<FeatureCurve> curves;
  std::vector<std::int32_t> corners;  // mesh nodes, ascending
  // Patches around each mesh node that lies on features, ascending; empty for other nodes.
  std::vector<std::vector<std::int32_t>> patches_at;
  // Nodes of sharp edges that belong to short creases.
  std::vector<std::array<std::int32_t, 2>> short_creases;

  bool is_corner(std::int32_t mesh_node) const;
};

// Surfaces within which edges are features only where listed, not by the angle of normals.
struct SmoothSurfaces {
  std::vector<std::int32_t> of;  // surface of each facet, or -1; empty if none exist
  // Nodes of their feature edges; ascending within a pair, and pairs sorted.
  std::vector<std::array<std::int32_t, 2>> creases;
};

// Finds the features. `feature_angle` is in degrees. The result depends only on the order of facets
// and nodes. Takes linear time except for sorting.
Features find_features(const BoundaryMesh<3>& mesh, double feature_angle,
                       const SmoothSurfaces& smooth = {});

// Returns the unit normal of a facet; 0 if it has no area.
Point<3> facet_normal(const BoundaryMesh<3>& mesh, const BoundaryTriangle& facet);

}  // namespace pnpbs
