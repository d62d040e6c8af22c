// SPDX-License-Identifier: BSD-3-Clause
#include "shape/signed_distance.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "geometry/facet_index.hpp"

namespace pnpbs {

namespace {

BoundaryEdge facet_of(const ShapePiece<2>& piece) {
  return {piece.ends[0], piece.ends[1], piece.tag, piece.front_inside, piece.back_inside};
}
BoundaryTriangle facet_of(const ShapePiece<3>& piece) {
  return {piece.ends, piece.tag, piece.front_inside, piece.back_inside};
}

// Returns the boundary pieces as a mesh. Throws Error(ErrorKind::argument) if none exist.
template <int Dim>
BoundaryMesh<Dim> mesh_of(const Shape<Dim>& shape) {
  BoundaryMesh<Dim> mesh;
  for (const ShapePiece<Dim>& piece : shape) {
    if (!piece.bounds()) continue;
    for (std::size_t k = 0; k < Dim; ++k) {
      const std::size_t end = static_cast<std::size_t>(piece.ends[k]);
      mesh.nodes.resize(std::max(mesh.nodes.size(), end + 1));
      mesh.nodes[end] = {piece.corners[k], piece.tag};
    }
    mesh.facets.push_back(facet_of(piece));
  }
  if (mesh.facets.empty())
    throw Error(ErrorKind::argument,
                "argument body has no inside: it is made of surfaces alone, or has no boundary");
  return mesh;
}

template <int Dim>
Box<Dim> bounds_of(const BoundaryMesh<Dim>& mesh) {
  Box<Dim> box = empty_box<Dim>();
  for (const BoundaryFacet<Dim>& facet : mesh.facets)
    for (const Point<Dim>& corner : corners_of(mesh, facet)) include<Dim>(box, corner);
  return box;
}

}  // namespace

template <int Dim>
SignedDistance<Dim>::SignedDistance(const Domain<Dim>& domain)
    : index_(shape_of(domain)), mesh_(mesh_of<Dim>(index_.shape())) {
  bounds_ = bounds_of(mesh_);
  sides_ = index_facets<Dim>(mesh_, bounds_);
}

template <int Dim>
std::vector<std::int32_t> SignedDistance<Dim>::facets_near(const Point<Dim>& x,
                                                           double reach) const {
  std::vector<std::int32_t> facets;
  sides_.for_facets_near(x, reach, [&](std::int32_t f) { facets.push_back(f); });
  std::ranges::sort(facets);
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

template class SignedDistance<2>;
template class SignedDistance<3>;

}  // namespace pnpbs
