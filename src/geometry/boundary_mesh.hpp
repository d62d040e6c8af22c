// SPDX-License-Identifier: BSD-3-Clause
// The discretized boundary of a level: nodes and straight facets between them, which are edges in
// the plane and triangles in space. Facets intersect in common nodes only.
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

// An edge of the boundary in the plane. If both ends are the same node, it is a fixed node and does
// not bound the domain.
struct BoundaryEdge {
  std::int32_t begin;  // Index into BoundaryMesh::nodes.
  std::int32_t end;
  std::int32_t tag;
  bool left_inside;
  bool right_inside;

  std::array<std::int32_t, 2> corners() const { return {begin, end}; }
  // Returns whether the domain lies on exactly one side.
  bool bounds() const { return left_inside != right_inside; }
};

// A triangle of the boundary in space. If two corners are the same node, it is a segment of an
// inner curve; if all three are, it is a fixed node. Neither side of a surface alone is inside.
struct BoundaryTriangle {
  std::array<std::int32_t, 3> nodes;  // Indices into BoundaryMesh::nodes.
  std::int32_t tag;
  // Whether the domain lies on the side of the normal, from which the corners are
  // counter-clockwise.
  bool front_inside;
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
  // Largest distance of nodes on facets from these facets. It is positive for level sets, whose
  // nodes lie on the zero set. Such a node can be in a cell of a background tree that no facet
  // meets.
  double node_distance = 0;
  Embedding<Dim> embedding{};  // Applies to all points.
};

// Positions of the corners of a facet.
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
