// SPDX-License-Identifier: BSD-3-Clause
// The boundary as a level sees it: nodes, and the straight facets between them, which are edges in
// the plane and triangles in space. Facets meet in common nodes only.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/types.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

template <int Dim>
struct BoundaryNode {
  Point<Dim> position;
  std::int32_t tag;
};

// With the same node at both ends it is a fixed node that bounds nothing.
struct BoundaryEdge {
  std::int32_t begin;  // index into BoundaryMesh::nodes
  std::int32_t end;
  std::int32_t tag;
  bool left_inside;
  bool right_inside;

  std::array<std::int32_t, 2> corners() const { return {begin, end}; }
  // Does the domain lie on one side only?
  bool bounds() const { return left_inside != right_inside; }
};

// Where corners are the same node it is a part of a curve inside, or a fixed node. Of surfaces
// alone, neither side is inside.
struct BoundaryTriangle {
  std::array<std::int32_t, 3> nodes;  // indices into BoundaryMesh::nodes
  std::int32_t tag;
  bool front_inside;  // the side to which the normal points: from there they turn left
  bool back_inside;

  const std::array<std::int32_t, 3>& corners() const { return nodes; }
  bool bounds() const { return front_inside != back_inside; }
  bool stands_alone() const { return !front_inside && !back_inside; }
};

template <int Dim>
using BoundaryFacet = std::conditional_t<Dim == 2, BoundaryEdge, BoundaryTriangle>;

template <int Dim>
struct BoundaryMesh {
  std::vector<BoundaryNode<Dim>> nodes;
  std::vector<BoundaryFacet<Dim>> facets;
  // Nodes placed on the facets are no farther from them than this: those of a level set are where
  // it is 0, which may be in a cell of a background tree that no facet meets.
  double node_distance = 0;
  Embedding<Dim> embedding{};  // of all points
};

// Where the corners of a facet are.
template <int Dim>
using FacetCorners = std::array<Point<Dim>, Dim>;

template <int Dim>
FacetCorners<Dim> corners_of(const BoundaryMesh<Dim>& mesh, const BoundaryFacet<Dim>& facet) {
  FacetCorners<Dim> corners;
  for (std::size_t k = 0; k < Dim; ++k)
    corners[k] = mesh.nodes[static_cast<std::size_t>(facet.corners()[k])].position;
  return corners;
}

}  // namespace pnpbs
