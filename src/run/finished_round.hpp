// SPDX-License-Identifier: BSD-3-Clause
// A run may take several rounds: where elements do not conform, or have small angles, d is held
// down and it goes on from its nodes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "level/level.hpp"
#include "method/constants.hpp"
#include "run/monitoring.hpp"
#include "run/outcome.hpp"
#include "run/run_state.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// One that has come to its end.
template <int Dim>
struct FinishedRound {
  std::shared_ptr<Level<Dim>> level;
  PlacedSpacing<Dim> placed;
  RunState state;
  Outcome outcome;
  std::int64_t small_angles;  // elements with one
};

// Which round counts: the first with elements that can be used, or a later one that leaves at most
// half of its small angles, and so on from there.
template <int Dim>
class BestRound {
 public:
  // Told of a round that has ended: is there anything to gain by another one?
  bool asks_for_another(Outcome outcome, std::int64_t small_angles) {
    const bool conforms = outcome != Outcome::not_conforming;
    last_is_best_ = conforms && (!best_ || leaves_few(small_angles));
    if (conforms && small_angles == 0) return false;
    if (best_ && !last_is_best_) ++in_vain_;
    return in_vain_ < method::kMaxRoundsInVain;
  }
  // That round, once another one has begun; what is not the best is let go.
  void offer(FinishedRound<Dim> last) {
    if (last_is_best_) best_ = std::move(last);
    last_is_best_ = false;
  }
  bool any_kept() const { return best_.has_value(); }
  bool last_counts() const { return last_is_best_ || !best_; }
  FinishedRound<Dim> take() { return std::move(*best_); }

 private:
  bool leaves_few(std::int64_t small_angles) const {
    return static_cast<double>(small_angles) <=
           method::kSmallAnglesLeft * static_cast<double>(best_->small_angles);
  }

  std::optional<FinishedRound<Dim>> best_;
  bool last_is_best_ = false;
  int in_vain_ = 0;
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
