// SPDX-License-Identifier: BSD-3-Clause
// Rounds of a run. A run repeats its steps and finish with d reduced locally if elements do not
// conform or have small angles. This file holds the result of a round and the choice of the best
// one.
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

// The result of a round that has reached its end.
template <int Dim>
struct FinishedRound {
  std::shared_ptr<Level<Dim>> level;
  PlacedSpacing<Dim> placed;
  RunState state;
  Outcome outcome;
  ElementFaults faults;
  std::int64_t small_angles;  // number of elements with a small angle

  bool conforms() const { return outcome != Outcome::not_conforming; }
};

// The best of the rounds of a run. Rounds whose elements conform are better than others. Among the
// others, the one with fewer faults is better. Among those that conform, a later round is better
// only if it leaves at most kSmallAnglesLeft of the small angles of the best one before.
template <int Dim>
class BestRound {
 public:
  // Returns whether another round may improve the result. Records whether `last` is the best round.
  bool needs_another(const FinishedRound<Dim>& last) {
    last_is_best_ = !best_ || is_better(last);
    if (last.conforms() && last.small_angles == 0) return false;
    const bool any_conforms = last.conforms() || (best_ && best_->conforms());
    if (last_is_best_)
      in_vain_ = any_conforms ? in_vain_ : 0;
    else
      ++in_vain_;
    return in_vain_ < (any_conforms ? method::kMaxRoundsInVain : method::kMaxRoundsInVainToConform);
  }
  // Stores `last`, once another round has begun, if it is the best one; otherwise releases it.
  void offer(FinishedRound<Dim> last) {
    if (last_is_best_) best_ = std::move(last);
    last_is_best_ = false;
  }
  // Returns whether the stored round has elements that conform.
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

// Returns the fraction of a run's work that is done when the round after `rounds` others begins.
// Each round does half of the remaining work.
inline double done_by_rounds(int rounds) {
  return rounds == 0 ? 0 : 1 - std::ldexp(1 - kStepsShare, 1 - rounds);
}

// Returns the range of fractions that the steps of a round cover, for the monitor. The ranges of
// successive rounds do not overlap, so the reported progress never decreases.
inline ProgressPart part_of_steps(int rounds, bool refined) {
  const double done = done_by_rounds(rounds);
  if (rounds > 0) return {done, (done + 1) / 2};
  return {refined ? kCoarseShare : 0, kStepsShare};
}

}  // namespace pnpbs
