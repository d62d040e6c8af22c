// SPDX-License-Identifier: BSD-3-Clause
// The shape of a domain as straight pieces, at the resolution at which it was given. Spacings that
// follow the shape are computed from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "domain/domain.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// A segment or a triangle. In space, a segment of an inner curve is (a, b, b); points are (a, a,
// a).
template <int Dim>
struct ShapePiece {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  FacetCorners<Dim> corners;
  std::array<std::int32_t, Dim> ends;  // numbers of the corners; pieces with a common number touch
  std::int32_t tag;
  bool front_inside, back_inside;  // front is left of a segment, or where a normal points
  double radius = kNone;           // smallest radius of curvature
  double edge = kNone;  // original length of a segment, or mean edge length of a triangle

  bool bounds() const { return front_inside != back_inside; }
  bool is_facet() const { return ends[0] != ends[1] && ends[Dim - 2] != ends[Dim - 1]; }
};

template <int Dim>
using Shape = std::vector<ShapePiece<Dim>>;

// Returns the shape of a checked domain. Smooth curves are approximated by chords within 1e-7 of
// the domain's size and have their own curvature. Polylines have the curvature of the circle
// through neighbouring vertices, and surfaces that by which the normals of neighbouring triangles
// turn, where they turn by less than the feature angle.
Shape<2> shape_of(const PlaneDomain& domain);
Shape<3> shape_of(const VolumeDomain& domain);

// Returns the shape of a checked domain on a sphere, with points in space. Radii of curvature and
// edge lengths are those along the sphere.
Shape<3> shape_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
