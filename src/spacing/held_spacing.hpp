// SPDX-License-Identifier: BSD-3-Clause
// A spacing that is held down at places, and grows from there by at most g per unit of length.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "base/execution.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class HeldSpacing : public Spacing<Dim> {
 public:
  HeldSpacing(std::shared_ptr<const Spacing<Dim>> raw, std::vector<GrowthSource<Dim>> places,
              double growth)
      : raw_(std::move(raw)), places_(std::move(places), growth) {}

  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override {
    raw_->evaluate(n, x, d);
    for_each("pnpbs::HeldSpacing", n, [&](std::int64_t i) { d[i] = places_.limit(x[i], d[i]); });
  }
  KnownValues<Dim> known_values() const override { return raw_->known_values(); }

 private:
  std::shared_ptr<const Spacing<Dim>> raw_;
  GrowthSources<Dim> places_;
};

}  // namespace pnpbs
