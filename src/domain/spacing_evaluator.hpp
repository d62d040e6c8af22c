// SPDX-License-Identifier: BSD-3-Clause
// Functions that evaluate the spacing d(x).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "base/types.hpp"

namespace pnpbs {

// Evaluates d at n points x. Throws Error if a value is not valid. Collective in a placement over
// several ranks.
template <int Dim>
using SpacingEvaluator = std::function<void(std::int64_t n, const Point<Dim>* x, double* d)>;

// An evaluator that a rank may call on its own. The constructor is explicit because most evaluators
// are collective.
template <int Dim>
class LocalSpacingEvaluator {
 public:
  explicit LocalSpacingEvaluator(SpacingEvaluator<Dim> local) : local_(std::move(local)) {}
  void operator()(std::int64_t n, const Point<Dim>* x, double* d) const { local_(n, x, d); }

 private:
  SpacingEvaluator<Dim> local_;
};

}  // namespace pnpbs
