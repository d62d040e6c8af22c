// SPDX-License-Identifier: BSD-3-Clause
// d(x) as those see it who only ask for it.
#pragma once

#include <cstdint>
#include <functional>

#include "base/types.hpp"

namespace pnpbs {

// Fills d[n] at x[n]; throws Error if a value is bad.
template <int Dim>
using SpacingEvaluator = std::function<void(std::int64_t n, const Point<Dim>* x, double* d)>;

}  // namespace pnpbs
