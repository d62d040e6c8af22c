// SPDX-License-Identifier: BSD-3-Clause
// What the pieces of a shape ask d to be at them: by curvature, by the width of the domain, and by
// the lengths of the input's edges.
#pragma once

#include <vector>

#include "shape/shape_index.hpp"

namespace pnpbs {

// What is asked for; 0: not at all.
struct ShapeDemands {
  double nodes_per_turn = 0;  // of a circle with the radius of curvature
  double nodes_across = 0;    // the width of the domain
  double nodes_per_edge = 0;  // of the input

  bool operator==(const ShapeDemands&) const = default;
};

// A piece that limits d around it: d is at most this, and more with the distance from it.
template <int Dim>
struct ShapeSource {
  FacetCorners<Dim> corners;
  double d;

  double limit(const Point<Dim>& at, double growth) const;
};

template <int Dim>
Box<Dim> box_of(const ShapeSource<Dim>& source) {
  Box<Dim> box{source.corners[0], source.corners[0]};
  for (const Point<Dim>& corner : source.corners) box = joined(box, Box<Dim>{corner, corner});
  return box;
}

// Those with a d below `max`. Where the width counts, pieces are halved until nothing that is ahead
// of them, or has their corners ahead, is nearer than twice their length. Throws
// Error(ErrorKind::spacing) if that makes too many.
template <int Dim>
std::vector<ShapeSource<Dim>> shape_sources(const ShapeIndex<Dim>& index,
                                            const ShapeDemands& demands, double max);

// Of a domain on a sphere, by the index of its chart: pieces of its curves in space, with d along
// the sphere.
std::vector<ShapeSource<3>> sources_on_sphere(const ShapeIndex<2>& in_chart,
                                              const StereographicChart& chart,
                                              const ShapeDemands& demands, double max);

}  // namespace pnpbs
