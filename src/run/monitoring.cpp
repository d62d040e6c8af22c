// SPDX-License-Identifier: BSD-3-Clause
#include "run/monitoring.hpp"

#include "base/error.hpp"

namespace pnpbs {

bool Monitoring::requests_stop(double fraction, std::int64_t nodes) const {
  return monitor_ && monitor_(fraction, run_.steps_done, nodes, run_.last_speeds.max);
}

bool Monitoring::is_due() const {
  constexpr auto kBetweenCalls = std::chrono::milliseconds(200);
  return monitor_ && Clock::now() - last_asked_ >= kBetweenCalls;
}

std::int64_t Monitoring::over_ranks(std::int64_t own_nodes) const {
  return static_cast<std::int64_t>(comm_.allreduce_sum(static_cast<std::uint64_t>(own_nodes)));
}

bool Monitoring::stops(double fraction, std::int64_t own_nodes) {
  bool stop = false;
  const std::int64_t nodes = over_ranks(own_nodes);
  collective_try(comm_, [&] { stop = requests_stop(fraction, nodes); });
  last_asked_ = Clock::now();
  return comm_.allreduce_max(stop) > 0;
}

bool Monitoring::stops_between_steps(bool at_event, bool level_stays, double fraction,
                                     std::int64_t own_nodes) {
  struct Turn {
    Monitoring& monitoring;
    ~Turn() { monitoring.between_steps_ = monitoring.at_event_ = false; }
  } turn{*this};
  between_steps_ = level_stays && !provisional_;
  at_event_ = at_event;
  return stops(fraction, own_nodes);
}

void Monitoring::watch(const std::string& what, std::int64_t own_nodes,
                       const std::function<void()>& work) {
  nodes_when_watched_ = over_ranks(own_nodes);
  last_asked_ = Clock::now();
  struct Watch {
    const std::string*& watched;
    const std::string* before;
    ~Watch() { watched = before; }
  } watch{watched_, std::exchange(watched_, &what)};
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::stopped) run_.stop_reason = StopReason::monitor;
    throw;
  }
}

void Monitoring::beat() {
  if (!watched_ || !is_due()) return;
  last_asked_ = Clock::now();
  if (requests_stop(0, nodes_when_watched_))
    throw Error(ErrorKind::stopped, "stopped by the monitor while " + *watched_);
}

}  // namespace pnpbs
