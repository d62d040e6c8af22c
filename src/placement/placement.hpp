// SPDX-License-Identifier: BSD-3-Clause
// A placement: nodes in a domain, and the time loop that brings them to rest.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"
#include "comm/ghost_sum.hpp"
#include "comm/ghost_update.hpp"
#include "implicit/repair_distances.hpp"
#include "level/finish.hpp"
#include "level/level_stamp.hpp"
#include "level/population_events.hpp"
#include "level/speeds.hpp"
#include "level/volume/surface_fit.hpp"
#include "placement/monitoring.hpp"
#include "placement/node_estimate.hpp"
#include "placement/option_changes.hpp"
#include "placement/outcome.hpp"
#include "placement/run_state.hpp"
#include "settings/options.hpp"

namespace pnpbs {

// Of the level there is, on this rank.
struct LevelFigures {
  std::int64_t neighbour_ranks = 0;
  std::int64_t exchange_bytes = 0;
  std::int64_t owned_work = 0;
};

// The nodes of a rank, as they lie in memory.
struct NodeColumns {
  std::int64_t count = 0;
  std::array<View<double>, 3> x;  // as many as there are dimensions
  View<double> d;
  View<std::int64_t> id;
  View<std::int32_t> tag;
  View<char> owned;
};

struct NearestNeighbourError {
  double mean = 0, deviation = 0, min = 0;  // of nearest-neighbour distance over d
};

// What is the same in any dimension. PlacementOf<Dim> is the rest of it.
class Placement {
 public:
  Placement(std::shared_ptr<const Communicator> comm, Options options)
      : comm_(std::move(comm)), options_(std::move(options)), monitoring_(*comm_, state_) {}
  virtual ~Placement() = default;

  virtual int dimension() const = 0;
  Options& options() { return options_; }
  const Options& options() const { return options_; }
  virtual void forget_nodes() = 0;  // lets go of everything that lives in Kokkos' memory
  Monitoring& monitoring() { return monitoring_; }
  const Monitoring& monitoring() const { return monitoring_; }

  // converged, or stopped by the monitor
  virtual Outcome initialise() = 0;
  virtual Outcome step(std::int64_t n) = 0;
  virtual Outcome run() = 0;
  // The counts are of what was done before a stop, too.
  virtual Outcome adjust_population(PopulationCounts& change) = 0;
  virtual Outcome rebalance() = 0;
  // Of a run from nothing; the nodes there are stay. Collective.
  virtual Estimate estimate() = 0;

  // --- results; nodes are handed out in the order of their ids ---
  virtual bool has_nodes() const = 0;
  virtual std::int64_t count() const = 0;  // of this rank
  std::int64_t global_count() const;       // collective
  virtual NodeColumns nodes() const = 0;   // as they lie in memory, ghosts among them
  // Memory index of each node in the order of ids, and the inverse. Preparing the lists (at their
  // extraction radius) or the stars prepares the order, too. The order alone changes nothing of
  // the level and may be asked for from a callback.
  virtual void prepare_order() = 0;
  virtual void prepare_lists() = 0;
  virtual void prepare_stars() = 0;
  std::int64_t node_at(std::int64_t place) const { return by_id_[static_cast<std::size_t>(place)]; }
  std::int64_t place_of(std::int64_t node) const { return place_[static_cast<std::size_t>(node)]; }
  // In places; the same object until nodes move. Collective.
  virtual std::shared_ptr<const ExchangePattern> exchange_pattern() = 0;
  std::int64_t nodes_on_ranks_before() const;

  // --- fields: values at nodes, [places][components], owned nodes first, then ghosts ---
  // Starts to bring the values of owned nodes to their ghosts. n: places there are values for.
  // Collective, and agreed.
  void begin_ghost_update(std::int64_t n, std::int64_t components, const double* values);
  // Waits for what the other ranks have started to send, and fills the ghosts. Local.
  void end_ghost_update(std::int64_t n, std::int64_t components, double* values);
  // Adds the values of ghosts to those of the nodes they stand for. Collective, and agreed.
  void add_from_ghosts(std::int64_t n, std::int64_t components, double* values);
  // Over the owned nodes of all ranks, of each component by itself: the exact sum of the values, or
  // of the products of two fields, rounded once. Collective, and agreed.
  void sum(std::int64_t n, std::int64_t components, const double* values, double* sums);
  void dot(std::int64_t n, std::int64_t components, const double* x, const double* y,
           double* products);
  const std::vector<std::string>& warnings() const { return state_.warnings; }

  // --- statistics ---
  const Timers& timers() const { return timers_; }
  const Communicator& communicator() const { return *comm_; }
  const std::shared_ptr<const Communicator>& ranks() const { return comm_; }
  std::int64_t steps_done() const { return state_.steps_done; }  // on all levels
  int coarser_levels() const { return state_.coarser_levels; }
  virtual std::int64_t rebuilds() const = 0;
  virtual std::int64_t rebalances() const = 0;
  std::int64_t inserted() const { return state_.inserted; }
  std::int64_t deleted() const { return state_.deleted; }
  std::int64_t dropped() const { return state_.dropped; }
  std::int64_t unknown_uses() const { return state_.unknown_uses; }
  std::int64_t missing_faces() const { return state_.surface_fit.missing_faces; }
  virtual std::int64_t left_out() const = 0;
  virtual std::int64_t unresolved_places() const = 0;
  // Of a body in space; of others all are 0.
  virtual RepairDistances repair_distances() const = 0;
  StopReason stop_reason() const { return state_.stop_reason; }
  // Has a run come to its end, and no step been done since?
  bool finished() const {
    return has_nodes() && state_.schedule.ended && state_.stop_reason != StopReason::monitor;
  }
  virtual Speeds speeds() const = 0;
  virtual LevelFigures level_figures() const = 0;
  virtual std::int64_t boundary_nodes() const = 0;  // of all ranks; collective
  virtual double imbalance() const = 0;             // collective
  virtual NearestNeighbourError spacing_error() = 0;
  // Of the simplices of the stars, and their edges. Collective.
  virtual const ElementQuality& element_quality() = 0;
  virtual std::uint64_t hash() const = 0;

 protected:
  // Of the level there is.
  virtual LevelStamp stamp() const = 0;
  void require_places(std::int64_t n) const;  // of all nodes and ghosts
  void require_owned(std::int64_t n) const;   // of all nodes at least
  void gather_terms(std::int64_t components, const double* x, const double* y);
  void finish_sums(double* sums);
  void require_same_options() const;
  void begin_schedule(bool refined);
  void begin_schedule_again();
  // Since the checkpoint that is read.
  void adopt_changes(const std::vector<OptionChange>& changes);
  bool spacing_missed();
  void warn_of_surface_fit();
  double bytes_allowed() const;
  PopulationCounts count_population_change(PopulationCounts change);
  void put_back(const RunState& before);

  std::shared_ptr<const Communicator> comm_;
  Options options_;
  RunState state_;
  Monitoring monitoring_;
  Timers timers_;

  // For which these were prepared last.
  LevelStamp order_stamp_, lists_stamp_, stars_stamp_, quality_stamp_, exchange_stamp_;
  std::vector<std::int32_t> by_id_, place_;
  std::int64_t owned_in_order_ = 0;  // of by_id_, the first ones
  std::shared_ptr<const ExchangePattern> exchange_pattern_;
  GhostUpdate ghost_update_;
  GhostSum ghost_sum_;
  std::vector<std::int64_t> sum_entries_;  // of the sums in progress, on their way over the ranks
  ElementQuality quality_;
};

}  // namespace pnpbs
