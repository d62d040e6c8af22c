// SPDX-License-Identifier: BSD-3-Clause
// A run may take several rounds: where elements do not conform, or have small angles, d is held
// down and it goes on from its nodes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "check/conformity.hpp"
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
  ElementFaults faults;
  std::int64_t small_angles;  // elements with one

  bool conforms() const { return outcome != Outcome::not_conforming; }
};

// Which round counts. Those whose elements conform are better than others. Of others the one with
// fewer faults is better; of those that conform, the first, or a later one that leaves at most half
// of its small angles, and so on from there.
template <int Dim>
class BestRound {
 public:
  // Is there anything to gain by another round after the last one?
  bool asks_for_another(const FinishedRound<Dim>& last) {
    last_is_best_ = !best_ || is_better(last);
    if (last.conforms() && last.small_angles == 0) return false;
    const bool any_conforms = last.conforms() || (best_ && best_->conforms());
    if (last_is_best_)
      in_vain_ = any_conforms ? in_vain_ : 0;
    else
      ++in_vain_;
    return in_vain_ < (any_conforms ? method::kMaxRoundsInVain : method::kMaxRoundsInVainToConform);
  }
  // That round, once another one has begun; what is not the best is let go.
  void offer(FinishedRound<Dim> last) {
    if (last_is_best_) best_ = std::move(last);
    last_is_best_ = false;
  }
  // Is a round kept whose elements conform?
  bool any_conforms() const { return best_ && best_->conforms(); }
  bool last_counts() const { return last_is_best_ || !best_; }
  FinishedRound<Dim> take() { return std::move(*best_); }

 private:
  bool is_better(const FinishedRound<Dim>& last) const {
    if (last.conforms() != best_->conforms()) return last.conforms();
    if (!last.conforms()) return last.faults < best_->faults;
    return static_cast<double>(last.small_angles) <=
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
