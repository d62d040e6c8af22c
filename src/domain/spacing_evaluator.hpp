// SPDX-License-Identifier: BSD-3-Clause
// d(x) as those see it who only ask for it.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "base/types.hpp"

namespace pnpbs {

// Fills d[n] at x[n]; throws Error if a value is bad. Collective in a placement over several ranks.
template <int Dim>
using SpacingEvaluator = std::function<void(std::int64_t n, const Point<Dim>* x, double* d)>;

// The same of a spacing that a rank may ask by itself. No other one becomes such unless it is said.
template <int Dim>
class LocalSpacingEvaluator {
 public:
  explicit LocalSpacingEvaluator(SpacingEvaluator<Dim> local) : local_(std::move(local)) {}
  void operator()(std::int64_t n, const Point<Dim>* x, double* d) const { local_(n, x, d); }

 private:
  SpacingEvaluator<Dim> local_;
};

}  // namespace pnpbs
