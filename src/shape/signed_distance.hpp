// SPDX-License-Identifier: BSD-3-Clause
// The signed distance from a point to the boundary of a domain.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet_index.hpp"
#include "shape/shape_index.hpp"

namespace pnpbs {

// Signed distance to the boundary of a domain. Queries are local and thread-safe.
template <int Dim>
class SignedDistance {
 public:
  // `domain` must be checked and need not outlive this object. Throws Error(ErrorKind::argument) if
  // the domain has no inside, such as surfaces alone.
  explicit SignedDistance(const Domain<Dim>& domain);
  SignedDistance(const SignedDistance&) = delete;  // the index points to the mesh
  SignedDistance& operator=(const SignedDistance&) = delete;

  // Returns the distance to the boundary, negative inside. It is exact up to rounding and to the
  // chords of smooth curves (shape_of).
  double operator()(const Point<Dim>& x) const {
    const double gap = index_.distance_to_boundary(x);
    return inside(x) ? -gap : gap;
  }
  // Returns the nearest point of the boundary.
  Point<Dim> foot(const Point<Dim>& x) const { return index_.nearest_on_boundary(x); }
  // Returns true if x lies strictly inside. The decision is exact for the facets.
  bool inside(const Point<Dim>& x) const { return sides_.inside(x); }

  // Returns the boundary facets that may come within `reach` of x, each once, ascending.
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
