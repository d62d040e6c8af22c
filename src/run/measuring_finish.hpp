// SPDX-License-Identifier: BSD-3-Clause
// Measures of a finished run, taken from its stars, which are also those of the results. All ranks
// must call these functions, and if one rank throws, all ranks throw.
#pragma once

#include "results/results.hpp"
#include "run/run_state.hpp"
#include "sizing/holding_spacing.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// Measures, in space, where the nodes do not follow d and where the tetrahedra do not follow the
// surfaces, and stores it in `run`. Does nothing in the plane.
void measure_finish(Results<2>& results, const PlacedSpacing<2>& placed, RunState& run);
void measure_finish(Results<3>& results, const PlacedSpacing<3>& placed, RunState& run);

// Sums the decisions that were based on data a rank does not know exactly. Adds a warning if there
// are any.
template <int Dim>
void gather_unknown_uses(const Level<Dim>& level, RunState& run);

// Returns whether elements of a finished level in space cross inner surfaces.
bool elements_cross_inner_surfaces(Results<2>& results);
bool elements_cross_inner_surfaces(Results<3>& results);

// Returns whether the elements fill the domain and their boundary is its boundary. If not, adds a
// warning. Sets `unresolved` to the points where d is to be reduced.
bool elements_conform(Results<2>& results, RunState& run, Unresolved<2>& unresolved);
bool elements_conform(Results<3>& results, RunState& run, Unresolved<3>& unresolved);

}  // namespace pnpbs
