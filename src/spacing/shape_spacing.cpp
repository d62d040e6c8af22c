// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/shape_spacing.hpp"

#include <algorithm>
#include <utility>

#include "base/started_execution.hpp"

namespace pnpbs {

template <int Dim>
ShapeSpacing<Dim>::ShapeSpacing(const ShapeIndex<Dim>& index, const ShapeDemands& demands,
                                const ShapeLimits& limits)
    : ShapeSpacing(shape_sources(index, demands, limits.max_in(index.size())), index.size(),
                   limits) {}

template <int Dim>
ShapeSpacing<Dim>::ShapeSpacing(std::vector<ShapeSource<Dim>> sources, double size,
                                const ShapeLimits& limits)
    : min_(limits.min),
      max_(limits.max_in(size)),
      growth_(limits.growth),
      sources_(std::make_shared<const GrowthSources<Dim, ShapeSource<Dim>>>(std::move(sources))) {}

template <int Dim>
void ShapeSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  for_each_if_started("pnpbs::ShapeSpacing", n, [&](std::int64_t i) {
    d[i] = factor_ * std::max(min_, sources_->limit(x[i], max_, growth_ / factor_));
  });
}

template <int Dim>
std::shared_ptr<const Spacing<Dim>> ShapeSpacing<Dim>::with_sizes_multiplied(double factor) const {
  auto resized = std::make_shared<ShapeSpacing>(*this);
  resized->factor_ *= factor;
  return resized;
}

template class ShapeSpacing<2>;
template class ShapeSpacing<3>;

}  // namespace pnpbs
