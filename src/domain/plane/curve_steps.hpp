// SPDX-License-Identifier: BSD-3-Clause
// Equal steps of the integral of ds/d along curves.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "domain/plane/curve_track.hpp"

namespace pnpbs {

// Fills d[n] at x[n]; throws Error if a value is bad.
using SpacingEvaluator = std::function<void(std::int64_t n, const Point<2>* x, double* d)>;

// The stations of each curve's nodes, its two ends included: n = max(1, round(integral)) steps
// (3 at least on closed curves). d is asked in large batches, for all curves together, at points
// less than a quarter of d apart; it is taken to be linear between them. Throws
// Error(ErrorKind::spacing) if that makes more than `most_nodes` nodes.
std::vector<std::vector<double>> lay_equal_steps(const std::vector<CurveTrack>& tracks,
                                                 const SpacingEvaluator& spacing,
                                                 std::int64_t most_nodes);

}  // namespace pnpbs
