// SPDX-License-Identifier: BSD-3-Clause
// A spacing of which places are known where it is finer than samples around them tell.
#pragma once

#include <memory>

#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class SpacingWithPlaces : public Spacing<Dim> {
 public:
  SpacingWithPlaces(std::shared_ptr<const Spacing<Dim>> spacing, KnownValues<Dim> places)
      : spacing_(std::move(spacing)), places_(std::move(places)) {}

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override {
    spacing_->evaluate(n, x, d);
  }
  KnownValues<Dim> known_values() const override {
    KnownValues<Dim> known = spacing_->known_values();
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(known.in_domain, places_.in_domain);
    append(known.slopes, places_.slopes);
    return known;
  }
  std::optional<GivenExtent<Dim>> extent() const override { return spacing_->extent(); }
  void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distances) const override {
    spacing_->distance_to_extent(n, x, distances);
  }

 private:
  std::shared_ptr<const Spacing<Dim>> spacing_;
  KnownValues<Dim> places_;
};

}  // namespace pnpbs
