// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock seconds for each phase of a run, the share of them in which the rank waited for
// others, and the number of nodes that each phase computes for, for the report.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace pnpbs {

// The phases of a run. `other` is everything that belongs to none of the others.
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
  other
};
inline constexpr std::size_t kPhases = static_cast<std::size_t>(Phase::other) + 1;

// Numbers of nodes that a phase computes for. A rank also computes for ghosts where this replaces
// messages.
struct NodesWorkedFor {
  std::int64_t all = 0, owned = 0;  // `all` includes ghosts; a node counts once per computation

  void add(const NodesWorkedFor& more) {
    all += more.all;
    owned += more.owned;
  }
};

// The times and node counts of all phases. Each moment belongs to one phase, the one that was
// entered last, so the phases sum up to the total.
class Timers {
 public:
  using Seconds = std::array<double, kPhases>;

  // `waited` are the seconds that this rank has spent in communication so far. It must outlive the
  // timers.
  explicit Timers(const double& waited) : waited_so_far_(&waited) {}

  double seconds(Phase phase) const { return seconds_[index(phase)]; }
  double total() const { return std::accumulate(seconds_.begin(), seconds_.end(), 0.0); }
  // Returns the seconds of a phase that this rank spent in communication: waiting for other ranks,
  // and the transfer itself.
  double waiting(Phase phase) const { return waiting_[index(phase)]; }
  double total_waiting() const { return std::accumulate(waiting_.begin(), waiting_.end(), 0.0); }

  const NodesWorkedFor& nodes(Phase phase) const { return nodes_[index(phase)]; }
  void add(Phase phase, const NodesWorkedFor& more) { nodes_[index(phase)].add(more); }

 private:
  friend class PhaseTimer;
  using Clock = std::chrono::steady_clock;

  static std::size_t index(Phase phase) { return static_cast<std::size_t>(phase); }

  // Adds the time since the last change to the present phase, if there is one, and enters another
  // phase or none. Returns the phase before.
  std::size_t change_to(std::size_t phase) {
    const Clock::time_point now = Clock::now();
    if (present_ < kPhases) {
      seconds_[present_] += std::chrono::duration<double>(now - since_).count();
      waiting_[present_] += *waited_so_far_ - waited_since_;
    }
    since_ = now;
    waited_since_ = *waited_so_far_;
    return std::exchange(present_, phase);
  }

  Seconds seconds_{}, waiting_{};
  std::array<NodesWorkedFor, kPhases> nodes_{};
  std::size_t present_ = kPhases;  // index of the present phase; kPhases: none
  Clock::time_point since_;
  double waited_since_ = 0;
  const double* waited_so_far_;
};

// Until the end of its scope time belongs to a phase, except while another PhaseTimer exists within
// the scope.
class PhaseTimer {
 public:
  PhaseTimer(Timers& timers, Phase phase)
      : timers_(timers), before_(timers.change_to(Timers::index(phase))) {}
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;
  ~PhaseTimer() { timers_.change_to(before_); }

 private:
  Timers& timers_;
  const std::size_t before_;
};

}  // namespace pnpbs
