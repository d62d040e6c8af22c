// SPDX-License-Identifier: BSD-3-Clause
// How far a point is from what bounds a domain, and on which side of it.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet_index.hpp"
#include "shape/shape_index.hpp"

namespace pnpbs {

template <int Dim>
class SignedDistance {
 public:
  // Of a checked domain, which need not outlive it. Throws Error(ErrorKind::argument) if nothing is
  // inside: of surfaces alone.
  explicit SignedDistance(const Domain<Dim>& domain);
  SignedDistance(const SignedDistance&) = delete;  // the index points to the mesh
  SignedDistance& operator=(const SignedDistance&) = delete;

  // Negative inside. Exact but for rounding and, of curves, the chords that stand for them
  // (shape_of).
  double operator()(const Point<Dim>& x) const {
    const double gap = index_.distance_to_boundary(x);
    return inside(x) ? -gap : gap;
  }
  // The nearest point of what bounds the domain.
  Point<Dim> foot(const Point<Dim>& x) const { return index_.nearest_on_boundary(x); }
  // Strictly; exact for the facets.
  bool inside(const Point<Dim>& x) const { return sides_.inside(x); }

  // Facets of the boundary that may come within `reach` of x, each once.
  std::vector<std::int32_t> facets_near(const Point<Dim>& x, double reach) const;
  const FacetCorners<Dim>& corners(std::int32_t facet) const { return sides_.corners(facet); }

  const Box<Dim>& bounds() const { return bounds_; }
  const Shape<Dim>& shape() const { return index_.shape(); }

 private:
  ShapeIndex<Dim> index_;
  Box<Dim> bounds_;
  BoundaryMesh<Dim> mesh_;
  FacetIndex<Dim> sides_;
};

extern template class SignedDistance<2>;
extern template class SignedDistance<3>;

}  // namespace pnpbs
