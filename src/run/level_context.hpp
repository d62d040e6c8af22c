// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "results/results.hpp"
#include "run/monitoring.hpp"
#include "run/run_state.hpp"

namespace pnpbs {

// What goes with a level while it is made.
template <int Dim>
struct LevelContext {
  RunState& run;           // counts what is done
  Monitoring& monitoring;  // may stop it
  Results<Dim>& results;   // show the level that is worked on
  double done;             // fraction of the call's work when it begins
};

}  // namespace pnpbs
