// SPDX-License-Identifier: BSD-3-Clause
// The surroundings in which a level is built: counts, monitor and results.
#pragma once

#include "results/results.hpp"
#include "run/monitoring.hpp"
#include "run/run_state.hpp"

namespace pnpbs {

// The objects that the construction of a level uses and updates.
template <int Dim>
struct LevelContext {
  RunState& run;           // counts steps and nodes
  Monitoring& monitoring;  // may stop the construction
  Results<Dim>& results;   // show the level under construction
  double done;             // fraction of the call's work that is done at the beginning
};

}  // namespace pnpbs
