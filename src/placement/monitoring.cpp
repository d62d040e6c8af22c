// SPDX-License-Identifier: BSD-3-Clause
// When the monitor is asked, and that all ranks stop if one is told to.
#include "base/error.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

// All stop if one rank's monitor asks for it.
bool Placement::monitor_stops(double fraction) {
  bool stop = false;
  const std::int64_t nodes = global_count();
  agreed(*comm_, [&] { stop = asks_to_stop(fraction, nodes); });
  last_asked_ = Clock::now();
  return comm_->allreduce_max(stop) > 0;
}

// Has this rank's monitor not been asked for a while?
bool Placement::monitor_is_due() const {
  constexpr auto kBetweenCalls = std::chrono::milliseconds(200);
  return monitor_ && Clock::now() - last_asked_ >= kBetweenCalls;
}

// The same of work that takes long only where nodes are many. All ranks ask, or none: a monitor may
// ask for what is collective.
bool Placement::monitor_stops_by_clock(double fraction) {
  return comm_->allreduce_max(monitor_is_due()) > 0 && monitor_stops(fraction);
}

// Between two steps of a level that stays, which is no coarser one, nodes can be saved.
bool Placement::monitor_stops_between_steps(bool is_event, double fraction) {
  struct Turn {
    Placement& placement;
    ~Turn() { placement.between_steps_ = placement.at_event_ = false; }
  } turn{*this};
  between_steps_ = !state_.schedule.coarser;
  at_event_ = is_event;
  return monitor_stops(fraction);
}

// The steps between two events of ten million nodes take some seconds. Several ranks have fewer
// nodes each, and would have to agree every time: they are asked at events.
template <int Dim>
bool PlacementOf<Dim>::stops_after_step(bool is_event, double fraction) {
  if (!is_event && (level_->distributed() || !monitor_is_due())) return false;
  return monitor_stops_between_steps(is_event, fraction);
}

// Work that leads to first nodes, or to those of a new spacing, and takes long where they are many:
// it calls beat() again and again, so that this rank's monitor is asked by the clock. Where it
// stops, all ranks do, with the nodes there were before. Collective.
void Placement::while_monitored(const std::string& what,
                                const std::function<void(const std::function<void()>&)>& work) {
  const std::int64_t nodes = global_count();
  last_asked_ = Clock::now();
  try {
    work([&] {
      if (!monitor_is_due()) return;
      last_asked_ = Clock::now();
      if (asks_to_stop(0, nodes))
        throw Error(ErrorKind::stopped, "stopped by the monitor while " + what);
    });
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::stopped) state_.stop_reason = StopReason::monitor;
    throw;
  }
}

template bool PlacementOf<2>::stops_after_step(bool, double);
template bool PlacementOf<3>::stops_after_step(bool, double);

}  // namespace pnpbs
