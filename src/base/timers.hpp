// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock seconds for each phase of a run, and the number of nodes that each phase computes for,
// for the report.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace pnpbs {

// The phases of a run. `total` is the whole run.
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

// Numbers of nodes that a phase computes for. A rank also computes for ghosts where this replaces
// messages.
struct NodesWorkedFor {
  std::int64_t all = 0, owned = 0;  // `all` includes ghosts; a node counts once per computation

  void add(const NodesWorkedFor& more) {
    all += more.all;
    owned += more.owned;
  }
};

// The times and node counts of all phases.
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

// A timer that adds the time until the end of its scope to a phase.
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
