// SPDX-License-Identifier: BSD-3-Clause
// Places nodes along curves at equal steps of the integral of ds/d, where s is the arc length.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/spacing_evaluator.hpp"

namespace pnpbs {

// Largest number of nodes on all curves together. Every rank stores these nodes and numbers them in
// 32 bits; the limit leaves room below 2^31 for corners and for rounding.
inline constexpr std::int64_t kMaxNodesOnCurves = 2'000'000'000;

// Returns for each curve the stations (arc lengths) of its nodes, both ends included. A curve has n
// = max(1, round(integral of ds/d)) steps, and at least 3 if it is closed.
// Evaluates d in large batches, for all curves together, at samples less than d/4 apart, and
// interpolates it linearly between them. `Track` is CurveTrack in the plane or PolylineTrack<3>.
// Throws Error(ErrorKind::spacing) if there would be more than `max_nodes` or kMaxNodesOnCurves
// nodes.
template <class Track>
std::vector<std::vector<double>> equal_step_stations(const std::vector<Track>& tracks,
                                                     const SpacingEvaluator<Track::kDim>& spacing,
                                                     std::int64_t max_nodes);

}  // namespace pnpbs
