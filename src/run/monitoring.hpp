// SPDX-License-Identifier: BSD-3-Clause
// When the user's monitor is asked, and that all ranks stop if one is told to.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "comm/communicator.hpp"
#include "run/run_state.hpp"

namespace pnpbs {

// The part of a call's work that is in progress, for the monitor: from a fraction to another.
struct ProgressPart {
  double begin = 0, end = 1;
};

// Shares of a run's work: coarser levels, and steps without the finish.
constexpr double kCoarseShare = 0.5, kStepsShare = 0.9;

class Monitoring {
 public:
  // fraction done of the call in progress, step, nodes, largest scaled speed -> true to stop
  using Monitor = std::function<bool(double, std::int64_t, std::int64_t, double)>;

  // The monitor is told where this run is; the run is told if the monitor stops it.
  Monitoring(const Communicator& comm, RunState& run) : comm_(comm), run_(run) {}
  Monitoring(const Monitoring&) = delete;
  Monitoring& operator=(const Monitoring&) = delete;

  void set(Monitor monitor) { monitor_ = std::move(monitor); }
  // Asks this rank's monitor. The nodes told are those of all ranks.
  bool asks_to_stop(double fraction, std::int64_t nodes) const;

  // Has this rank's monitor not been asked for a while?
  bool is_due() const;
  // The same of any rank: all ask, or none, as a monitor may ask for what is collective.
  // Collective.
  bool is_due_anywhere() const { return comm_.allreduce_max(is_due()) > 0; }

  // Asks on all ranks, which have these nodes of their own: all stop if one rank's monitor asks for
  // it. Collective.
  bool stops(double fraction, std::int64_t own_nodes);
  // The same between two steps. Of a level that stays, the nodes can be saved then. Collective.
  bool stops_between_steps(bool at_event, bool level_stays, double fraction,
                           std::int64_t own_nodes);
  // Is this a monitor's turn in which they can be? At an event?
  bool between_steps() const { return between_steps_; }
  bool at_event() const { return at_event_; }

  // While there is one for nodes that may not count in the end, they cannot be saved.
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

  // Does work that leads to first nodes, or to those of a new spacing, and takes long where they
  // are many. It calls beat() again and again, so that this rank's monitor is asked by the clock.
  // Where one rank's stops, all ranks do. Throws Error(ErrorKind::stopped) then. Collective.
  void watch(const std::string& what, std::int64_t own_nodes, const std::function<void()>& work);
  // Asks the monitor if work is watched and the monitor has not been asked for a while. Local.
  void beat();

 private:
  using Clock = std::chrono::steady_clock;

  std::int64_t over_ranks(std::int64_t own_nodes) const;

  const Communicator& comm_;
  RunState& run_;
  Monitor monitor_;
  Clock::time_point last_asked_ = Clock::now();
  bool between_steps_ = false, at_event_ = false;  // while the monitor is asked
  bool provisional_ = false;
  const std::string* watched_ = nullptr;  // what is done while work is watched
  std::int64_t nodes_when_watched_ = 0;
};

}  // namespace pnpbs
