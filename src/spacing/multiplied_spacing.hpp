// SPDX-License-Identifier: BSD-3-Clause
// A spacing times a factor.
#pragma once

#include <memory>

#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class MultipliedSpacing : public Spacing<Dim> {
 public:
  MultipliedSpacing(std::shared_ptr<const Spacing<Dim>> spacing, double factor)
      : spacing_(std::move(spacing)), factor_(factor) {}

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override {
    spacing_->evaluate(n, x, d);
    for (std::int64_t i = 0; i < n; ++i) d[i] *= factor_;
  }

  KnownValues<Dim> known_values() const override {
    KnownValues<Dim> known = spacing_->known_values();
    for (GrowthSource<Dim>& value : known.values) value.d *= factor_;
    for (GrowthSource<Dim>& value : known.in_domain) value.d *= factor_;
    for (auto& slope : known.slopes) slope.growth *= factor_, slope.d *= factor_;
    return known;
  }

 private:
  std::shared_ptr<const Spacing<Dim>> spacing_;
  double factor_;
};

// For `factor` times the distance between nodes: its growth multiplied, too, only if it is not
// known what else there is to it.
template <int Dim>
std::shared_ptr<const Spacing<Dim>> resized(const std::shared_ptr<const Spacing<Dim>>& spacing,
                                            double factor) {
  if (auto sizes = spacing->with_sizes_multiplied(factor)) return sizes;
  return std::make_shared<MultipliedSpacing<Dim>>(spacing, factor);
}

}  // namespace pnpbs
