// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock seconds by phase, and the nodes a phase worked for, for the report.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

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
  conformity,
  total
};
inline constexpr std::size_t kPhases = static_cast<std::size_t>(Phase::total) + 1;

// Ghosts are worked for so that a rank finds itself what others decide.
struct NodesWorkedFor {
  std::int64_t all = 0, owned = 0;  // with ghosts; each as often as it was worked for

  void add(const NodesWorkedFor& more) {
    all += more.all;
    owned += more.owned;
  }
};

class Timers {
 public:
  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
  void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }
  const NodesWorkedFor& nodes(Phase phase) const { return nodes_[static_cast<std::size_t>(phase)]; }
  void add(Phase phase, const NodesWorkedFor& more) {
    nodes_[static_cast<std::size_t>(phase)].add(more);
  }

 private:
  std::array<double, kPhases> seconds_{};
  std::array<NodesWorkedFor, kPhases> nodes_{};
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
