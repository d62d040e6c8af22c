// SPDX-License-Identifier: BSD-3-Clause
// A spacing on a sphere, converted to a chart of the sphere.
#pragma once

#include <memory>
#include <utility>

#include "spacing/spacing.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// A spacing in a chart: the spacing on the sphere times the stretch of the chart.
class SphereSpacing : public LocalSpacing<2> {
 public:
  // `along` is the spacing at points of the sphere.
  SphereSpacing(std::shared_ptr<const LocalSpacing<3>> along, const StereographicChart& chart)
      : along_(std::move(along)), chart_(chart) {}

  // Throws Error(ErrorKind::spacing) if d is not finite and greater than 0.
  void evaluate(std::int64_t n, const Point<2>* u, double* d) const override;
  SpacingHints<2> spacing_hints() const override;
  std::optional<GivenExtent<2>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<2>* u, double* distances) const override;

 private:
  std::shared_ptr<const LocalSpacing<3>> along_;
  StereographicChart chart_;
};

// Returns the spacing in the chart of make(radius), which makes a spacing on the sphere. Returns
// null if the embedding is not that of a sphere.
template <class Make>
std::shared_ptr<const LocalSpacing<2>> spacing_on_sphere(const Embedding<2>& embedding,
                                                         const Make& make) {
  if (!embedding.is_sphere()) return nullptr;
  return std::make_shared<const SphereSpacing>(make(embedding.radius()), embedding.chart());
}
template <class Make>
std::shared_ptr<const LocalSpacing<3>> spacing_on_sphere(const Embedding<3>&, const Make&) {
  return nullptr;
}

}  // namespace pnpbs
