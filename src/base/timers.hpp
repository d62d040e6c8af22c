// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock seconds by phase, for the report.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace pnpbs {

enum class Phase {
  boundary,
  tree,
  partition,
  fill,
  spacing,
  lists,
  motion,
  exchange,
  population,
  stars,
  sweeps,
  total
};
inline constexpr std::size_t kPhases = static_cast<std::size_t>(Phase::total) + 1;

class Timers {
 public:
  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
  void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }
  void reset() { seconds_.fill(0); }

 private:
  std::array<double, kPhases> seconds_{};
};

// Counts the time from here to the end of the scope.
class PhaseTimer {
 public:
  PhaseTimer(Timers& timers, Phase phase)
      : timers_(timers), phase_(phase), start_(std::chrono::steady_clock::now()) {}
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;
  ~PhaseTimer() {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    timers_.add(phase_, passed.count());
  }

 private:
  Timers& timers_;
  Phase phase_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace pnpbs
