// SPDX-License-Identifier: BSD-3-Clause
// A spacing that follows the shape of a domain: the least that its pieces ask for, each growing
// with the distance from it.
#pragma once

#include <memory>
#include <vector>

#include "shape/shape_index.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// What the pieces of a shape ask d to be at them, by curvature, by the width of the domain, and by
// the lengths of the input's edges; 0: not at all.
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

struct ShapeLimits {
  double growth = 0.15;  // of d per unit of distance from a piece
  double min = 0;
  double max = 0;  // 0: the size of the domain

  double max_in(double size) const { return max > 0 ? max : size; }
  bool operator==(const ShapeLimits&) const = default;
};

template <int Dim>
class ShapeSpacing : public LocalSpacing<Dim> {
 public:
  // The index is looked at here alone.
  ShapeSpacing(const ShapeIndex<Dim>& index, const ShapeDemands& demands,
               const ShapeLimits& limits);
  // d of these pieces, in a domain of that size.
  ShapeSpacing(std::vector<ShapeSource<Dim>> sources, double size, const ShapeLimits& limits);

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // What the pieces ask for and the bounds are multiplied.
  std::shared_ptr<const Spacing<Dim>> with_sizes_multiplied(double factor) const override;

 private:
  double factor_ = 1;
  double min_, max_;  // before it is multiplied, as the d of sources
  double growth_;
  std::shared_ptr<const GrowthSources<Dim, ShapeSource<Dim>>> sources_;
};

extern template class ShapeSpacing<2>;
extern template class ShapeSpacing<3>;

}  // namespace pnpbs
