// SPDX-License-Identifier: BSD-3-Clause
// The line of sight in a plane domain whose boundary is discretised at a spacing.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "domain/plane/plane_domain.hpp"
#include "spacing/line_of_sight.hpp"
#include "spacing/spacing.hpp"

inline std::unique_ptr<const pnpbs::LineOfSight<2>> line_of_sight(
    const pnpbs::PlaneDomain& domain, const pnpbs::Spacing<2>& spacing) {
  const pnpbs::SpacingEvaluator<2> evaluator = [&](std::int64_t n, const pnpbs::Point<2>* x,
                                                   double* d) {
    pnpbs::evaluate_spacing<2>(spacing, domain.area(), n, x, d);
  };
  return std::make_unique<const pnpbs::LineOfSight<2>>(
      domain.bounds(), domain.area(),
      pnpbs::indexed_boundary(domain, evaluator, std::numeric_limits<std::int64_t>::max()));
}
