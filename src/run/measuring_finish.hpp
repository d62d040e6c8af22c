// SPDX-License-Identifier: BSD-3-Clause
// What the stars of a finished run tell, the same from which results are handed out. All functions
// are collective.
#pragma once

#include "results/results.hpp"
#include "run/run_state.hpp"
#include "sizing/holding_spacing.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// In space, where the nodes do not follow d, or the tetrahedra the surfaces, for the run.
void measure_finish(Results<2>& results, const PlacedSpacing<2>& placed, RunState& run);
void measure_finish(Results<3>& results, const PlacedSpacing<3>& placed, RunState& run);

// Uses of what a rank does not know exactly, for the run, with a warning if there are any.
template <int Dim>
void gather_unknown_uses(const Level<Dim>& level, RunState& run);

// If not there is a warning.
bool elements_conform(Results<2>& results, RunState& run, Unresolved<2>& unresolved);
bool elements_conform(Results<3>& results, RunState& run, Unresolved<3>& unresolved);

}  // namespace pnpbs
