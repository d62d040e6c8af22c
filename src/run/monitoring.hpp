// SPDX-License-Identifier: BSD-3-Clause
// The calls of the user's monitor. If the monitor of one rank requests a stop, all ranks stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "comm/communicator.hpp"
#include "run/run_state.hpp"

namespace pnpbs {

// The range of the call's work that is in progress, as fractions for the monitor.
struct ProgressPart {
  double begin = 0, end = 1;
};

// Fractions of a run's work, for the monitor: the coarser levels, and everything before the finish.
constexpr double kCoarseShare = 0.5, kStepsShare = 0.9;

// Calls the user's monitor at suitable times and spreads its answer over the ranks.
class Monitoring {
 public:
  // Arguments: fraction done of the call in progress, steps done, number of nodes, largest scaled
  // speed. Returns true to stop.
  using Monitor = std::function<bool(double, std::int64_t, std::int64_t, double)>;

  // Reads the progress for the monitor from `run`, and records in it that a monitor stops a call.
  // Both references must outlive this object.
  Monitoring(const Communicator& comm, RunState& run) : comm_(comm), run_(run) {}
  Monitoring(const Monitoring&) = delete;
  Monitoring& operator=(const Monitoring&) = delete;

  void set(Monitor monitor) { monitor_ = std::move(monitor); }
  // Calls the monitor of this rank and returns whether it requests a stop. `nodes` is the number on
  // all ranks. Local.
  bool requests_stop(double fraction, std::int64_t nodes) const;

  // Returns whether the monitor of this rank was not called for a while. Local.
  bool is_due() const;
  // Returns whether that holds on any rank. Either all ranks call their monitors or none does,
  // since a monitor may call collective functions. Collective.
  bool is_due_anywhere() const { return comm_.allreduce_max(is_due()) > 0; }

  // Calls the monitors of all ranks. Returns true on all ranks if one of them requests a stop.
  // `own_nodes` is the number of nodes that this rank owns. All ranks must call it, and if one rank
  // throws, all ranks throw.
  bool stops(double fraction, std::int64_t own_nodes);
  // Does the same between two steps. If `level_stays` is true, the monitor may save the nodes.
  // Collective.
  bool stops_between_steps(bool at_event, bool level_stays, double fraction,
                           std::int64_t own_nodes);
  // Return whether a monitor is being called that may save the nodes, and whether it is called at
  // an event.
  bool between_steps() const { return between_steps_; }
  bool at_event() const { return at_event_; }

  // A scope in which the nodes may be discarded later, so monitors cannot save them.
  class Provisional {
   public:
    Provisional(Monitoring& monitoring, bool provisional)
        : monitoring_(monitoring), before_(monitoring.provisional_) {
      monitoring.provisional_ = provisional;
    }
    Provisional(const Provisional&) = delete;
    Provisional& operator=(const Provisional&) = delete;
    ~Provisional() { monitoring_.provisional_ = before_; }

   private:
    Monitoring& monitoring_;
    bool before_;
  };

  // Runs `work`, a long computation of first nodes or of nodes for a new spacing. `work` calls
  // beat() regularly, which calls the monitor of this rank in intervals of time. `what` completes
  // the message "stopped by the monitor while". Throws Error(ErrorKind::stopped) on all ranks if
  // the monitor of one rank stops it. Collective.
  void watch(const std::string& what, std::int64_t own_nodes, const std::function<void()>& work);
  // Calls the monitor if watch() is in progress and the monitor was not called for a while. Throws
  // Error(ErrorKind::stopped) if it requests a stop. Local.
  void beat();

 private:
  using Clock = std::chrono::steady_clock;

  std::int64_t over_ranks(std::int64_t own_nodes) const;

  const Communicator& comm_;
  RunState& run_;
  Monitor monitor_;
  Clock::time_point last_asked_ = Clock::now();
  bool between_steps_ = false, at_event_ = false;  // while a monitor is called
  bool provisional_ = false;
  const std::string* watched_ = nullptr;  // description of the work in watch(), or null
  std::int64_t nodes_when_watched_ = 0;
};

}  // namespace pnpbs
