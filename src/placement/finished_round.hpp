// SPDX-License-Identifier: BSD-3-Clause
// A run may take several rounds: where elements do not conform, or have small angles, d is held
// down and it goes on from its nodes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>

#include "level/level.hpp"
#include "placement/monitoring.hpp"
#include "placement/outcome.hpp"
#include "placement/placed_spacing.hpp"
#include "placement/run_state.hpp"

namespace pnpbs {

// One that has come to its end.
template <int Dim>
struct FinishedRound {
  std::unique_ptr<Level<Dim>> level;
  PlacedSpacing<Dim> placed;
  RunState state;
  Outcome outcome;
  std::int64_t small_angles;  // elements with one
};

// Of a run's work, what is done when a round after so many others begins. Each does half of the
// rest.
inline double done_by_rounds(int rounds) {
  return rounds == 0 ? 0 : 1 - std::ldexp(1 - kStepsShare, 1 - rounds);
}

// Of a run's work, the part that the steps of this round are: what has been done is not told again.
inline ProgressPart part_of_steps(int rounds, bool refined) {
  const double done = done_by_rounds(rounds);
  if (rounds > 0) return {done, (done + 1) / 2};
  return {refined ? kCoarseShare : 0, kStepsShare};
}

}  // namespace pnpbs
