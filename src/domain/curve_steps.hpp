// SPDX-License-Identifier: BSD-3-Clause
// Equal steps of the integral of ds/d along curves.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/spacing_evaluator.hpp"

namespace pnpbs {

// Every rank holds all nodes on curves, and numbers them in 32 bits: these many, corners, and those
// that rounding adds.
inline constexpr std::int64_t kMaxNodesOnCurves = 2'000'000'000;

// The stations of each curve's nodes, its two ends included: n = max(1, round(integral)) steps
// (3 at least on closed curves). d is asked in large batches, for all curves together, at points
// less than a quarter of d apart; it is taken to be linear between them. Throws
// Error(ErrorKind::spacing) if that makes more than `max_nodes` nodes, or more than every rank can
// hold. A track is a CurveTrack of the plane or a PolylineTrack<3>.
template <class Track>
std::vector<std::vector<double>> lay_equal_steps(const std::vector<Track>& tracks,
                                                 const SpacingEvaluator<Track::kDim>& spacing,
                                                 std::int64_t max_nodes);

}  // namespace pnpbs
