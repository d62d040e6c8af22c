// SPDX-License-Identifier: BSD-3-Clause
// A spacing that follows the shape of a domain: the least that its pieces ask for, each growing
// with the distance from it.
#pragma once

#include <memory>
#include <vector>

#include "spacing/growth_sources.hpp"
#include "spacing/shape_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

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
