// SPDX-License-Identifier: BSD-3-Clause
// A spacing that follows the shape of a domain: the smallest spacing that its pieces require, each
// growing with the distance from the piece.
#pragma once

#include <memory>
#include <vector>

#include "shape/shape_index.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// The requirements of pieces of a shape on d: by curvature, by the width of the domain, and by the
// edge lengths of the input. 0 disables a requirement.
struct ShapeRequirements {
  double nodes_per_turn = 0;  // nodes on a full circle with the radius of curvature
  double nodes_across = 0;    // nodes across the width of the domain
  double nodes_per_edge = 0;  // nodes on an edge of the input

  bool operator==(const ShapeRequirements&) const = default;
};

// A piece that limits d around it: d is at most `d` on the piece and grows with the distance from
// it.
template <int Dim>
struct ShapeSource {
  FacetCorners<Dim> corners;
  double d;

  // Returns the upper bound of d at a point.
  double limit(const Point<Dim>& at, double growth) const;
};

template <int Dim>
Box<Dim> box_of(const ShapeSource<Dim>& source) {
  Box<Dim> box{source.corners[0], source.corners[0]};
  for (const Point<Dim>& corner : source.corners) box = joined(box, Box<Dim>{corner, corner});
  return box;
}

// Returns the pieces whose d is below `max`. If the width counts, pieces are bisected until nothing
// in front of them, or with their corners in front of it, is nearer than twice their length. Throws
// Error(ErrorKind::spacing) if this makes too many pieces.
template <int Dim>
std::vector<ShapeSource<Dim>> shape_sources(const ShapeIndex<Dim>& index,
                                            const ShapeRequirements& demands, double max);

// Returns the same for a domain on a sphere from the index of its chart: pieces of its curves in
// space, with d along the sphere.
std::vector<ShapeSource<3>> sources_on_sphere(const ShapeIndex<2>& in_chart,
                                              const StereographicChart& chart,
                                              const ShapeRequirements& demands, double max);

// Bounds of a ShapeSpacing.
struct ShapeLimits {
  double growth = 0.15;  // growth of d per unit of distance from a piece
  double min = 0;
  double max = 0;  // the size of the domain if 0

  double max_in(double size) const { return max > 0 ? max : size; }
  bool operator==(const ShapeLimits&) const = default;
};

// A spacing that the pieces of a shape determine.
template <int Dim>
class ShapeSpacing : public LocalSpacing<Dim> {
 public:
  // Computes the sources from the index, which is not stored.
  ShapeSpacing(const ShapeIndex<Dim>& index, const ShapeRequirements& demands,
               const ShapeLimits& limits);
  // Uses these sources in a domain of this size.
  ShapeSpacing(std::vector<ShapeSource<Dim>> sources, double size, const ShapeLimits& limits);

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // Returns this spacing with the d of the pieces and the bounds multiplied.
  std::shared_ptr<const Spacing<Dim>> with_sizes_multiplied(double factor) const override;

 private:
  double factor_ = 1;
  double min_, max_;  // before multiplication by factor_, like the d of the sources
  double growth_;
  std::shared_ptr<const GrowthSources<Dim, ShapeSource<Dim>>> sources_;
};

extern template class ShapeSpacing<2>;
extern template class ShapeSpacing<3>;

}  // namespace pnpbs
