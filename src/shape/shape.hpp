// SPDX-License-Identifier: BSD-3-Clause
// The shape of a domain in straight pieces, as fine as it is given: what a spacing that follows the
// shape is made from.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "domain/domain.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// A segment or a triangle. In space a part of a curve inside is (a, b, b); points are (a, a, a).
template <int Dim>
struct ShapePiece {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  FacetCorners<Dim> corners;
  std::array<std::int32_t, Dim> ends;  // numbers of the corners: pieces that share one touch
  std::int32_t tag;
  bool front_inside, back_inside;  // front: left of the way along a segment, or where the normal is
  double radius = kNone;           // of curvature, the least
  double edge = kNone;  // length of a segment, mean length of a triangle's edges, as it was given

  bool bounds() const { return front_inside != back_inside; }
  bool is_facet() const { return ends[0] != ends[1] && ends[Dim - 2] != ends[Dim - 1]; }
};

template <int Dim>
using Shape = std::vector<ShapePiece<Dim>>;

// Of a checked domain. Arcs and curves by callback are cut into chords that keep within 1e-7 of the
// domain's size of them, and have their own curvature; polylines have that of the circle through
// neighbouring vertices, surfaces that by which the normals of neighbouring triangles turn: both
// where they turn by less than the feature angle.
Shape<2> shape_of(const PlaneDomain& domain);
Shape<3> shape_of(const VolumeDomain& domain);

// Of a checked domain. Radii of curvature and lengths of edges are those along the sphere.
Shape<3> shape_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
