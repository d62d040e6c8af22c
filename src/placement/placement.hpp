// SPDX-License-Identifier: BSD-3-Clause
// The placement of nodes in a domain: its options, its state, and the calls of the interface.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "check/boundary_distance.hpp"
#include "checkpoint/option_changes.hpp"
#include "comm/communicator.hpp"
#include "estimate/node_estimate.hpp"
#include "implicit/repaired_body.hpp"
#include "level/population_events.hpp"
#include "results/nodal_results.hpp"
#include "run/monitoring.hpp"
#include "run/outcome.hpp"
#include "run/run_state.hpp"
#include "settings/options.hpp"

namespace pnpbs {

// The part of a placement that does not depend on the dimension. PlacementImpl<Dim> implements the
// rest.
class Placement {
 public:
  Placement(std::shared_ptr<const Communicator> comm, Options options)
      : comm_(std::move(comm)), options_(std::move(options)), monitoring_(*comm_, state_) {}
  virtual ~Placement() = default;

  virtual int dimension() const = 0;
  Options& options() { return options_; }
  const Options& options() const { return options_; }
  virtual void release_nodes() = 0;  // releases all Kokkos memory
  Monitoring& monitoring() { return monitoring_; }
  const Monitoring& monitoring() const { return monitoring_; }

  // These calls return `converged` if they reach their end, `stopped` if the monitor stops them, or
  // another outcome of a finished run. All ranks must call them, and if one rank throws, all ranks
  // throw.
  virtual Outcome initialise() = 0;
  virtual Outcome step(std::int64_t n) = 0;
  virtual Outcome run() = 0;
  // Sets `change` to the counts of this call, also if the monitor stops it.
  virtual Outcome adjust_population(PopulationCounts& change) = 0;
  virtual Outcome rebalance() = 0;
  // Estimates a run that begins without nodes. The present nodes are not changed. Collective.
  virtual Estimate estimate() = 0;

  virtual NodalResults& results() = 0;
  virtual const NodalResults& results() const = 0;
  const std::vector<Warning>& warnings() const { return state_.warnings; }

  // --- statistics ---
  const Timers& timers() const { return timers_; }
  const Communicator& communicator() const { return *comm_; }
  const std::shared_ptr<const Communicator>& ranks() const { return comm_; }
  std::int64_t steps_done() const { return state_.steps_done; }  // on all levels
  int coarser_levels() const { return state_.coarser_levels; }
  std::int64_t rebuilds() const {
    return state_.rebuilds_before + results().level_figures().rebuilds;
  }
  std::int64_t rebalances() const {
    return state_.rebalances_before + results().level_figures().rebalances;
  }
  std::int64_t inserted() const { return state_.inserted; }
  std::int64_t deleted() const { return state_.deleted; }
  std::int64_t dropped() const { return state_.dropped; }
  std::int64_t unknown_uses() const { return state_.unknown_uses; }
  std::int64_t missing_faces() const { return state_.surface_fit.faces_off; }
  // Measures of a body in space. They are 0 for other domains. Collective.
  virtual double volume_of_elements() = 0;
  virtual double volume_of_domain() const = 0;
  virtual BoundaryDistance boundary_distance() = 0;
  virtual std::int64_t unresolved_places() const = 0;
  // Returns the number of nodes that was expected when d was last reduced at unresolved points.
  virtual std::int64_t unresolved_nodes() const = 0;
  // Returns the smallest d at unresolved points before it was reduced.
  virtual double unresolved_spacing() const = 0;
  // Returns the distances of the repaired surface of a body in space, or zeros for other domains.
  virtual RepairDistances repair_distances() const = 0;
  StopReason stop_reason() const { return state_.stop_reason; }
  Outcome outcome() const { return state_.outcome; }  // of the last run that reached its end
  // Returns whether a run has reached its end and no step has been done since.
  bool finished() const {
    return shows_its_level() && state_.schedule.ended() &&
           state_.stop_reason != StopReason::monitor;
  }

 protected:
  // Returns whether the results show the level that the schedule belongs to. During the
  // construction of a level they may show an intermediate one.
  virtual bool shows_its_level() const = 0;
  std::int64_t global_count() const { return results().global_count(); }  // collective
  // Throws Error(ErrorKind::argument) on all ranks if the options differ between ranks. Collective.
  void require_same_options() const;
  // Adapts the schedule and the warnings to the options that changed since the checkpoint was
  // written.
  void adopt_changes(const std::vector<OptionChange>& changes);
  void restore_run(RunState before) noexcept;

  std::shared_ptr<const Communicator> comm_;
  Options options_;
  RunState state_;
  Monitoring monitoring_;
  Timers timers_{comm_->seconds_waited()};
};

}  // namespace pnpbs
