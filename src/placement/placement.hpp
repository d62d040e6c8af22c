// SPDX-License-Identifier: BSD-3-Clause
// A placement: nodes in a domain, and the time loop that brings them to rest.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"
#include "level/finish.hpp"
#include "level/level.hpp"
#include "level/population_events.hpp"
#include "level/speeds.hpp"
#include "level/taken_nodes.hpp"
#include "placement/node_estimate.hpp"
#include "settings/options.hpp"

namespace pnpbs {

// Where the simulation of a level is. Events happen at step numbers of it.
struct Schedule {
  std::int64_t step = 0;
  bool refined = false;  // it began with the nodes of a coarser level
  bool coarser = false;  // it is one
  bool ended = false;
  bool population_settled = false;
  int quiet_events = 0;          // that changed too little to pay, in a row
  double imbalance_reached = 1;  // by the last rebalancing
};

// The part of a call's work that is in progress, for the monitor: from a fraction to another.
struct ProgressPart {
  double begin = 0, end = 1;
};

// spacing_missed: somewhere the nodes do not follow d, whether the bubbles rest or not.
enum class Outcome { converged, not_converged, stopped, spacing_missed };

// Why a run ended, for the report.
enum class StopReason { none, rest, step_limit, monitor };

struct NearestNeighbourError {
  double mean = 0, deviation = 0, min = 0;  // of nearest-neighbour distance over d
};

class Placement {
 public:
  // fraction done of the call in progress, step, nodes, largest scaled speed -> true to stop
  using Monitor = std::function<bool(double, std::int64_t, std::int64_t, double)>;

  Placement(std::shared_ptr<const Communicator> comm, std::shared_ptr<PlaneDomain> domain,
            Options options)
      : comm_(std::move(comm)), domain_(std::move(domain)), options_(std::move(options)) {}

  Options& options() { return options_; }
  const Options& options() const { return options_; }
  void set_spacing(std::shared_ptr<const Spacing<2>> spacing);
  void set_nodes(GivenNodes nodes);
  void forget_nodes();  // lets go of everything that lives in Kokkos' memory
  void set_monitor(Monitor monitor) { monitor_ = std::move(monitor); }
  // Asks this rank's monitor. The nodes told are those of all ranks.
  bool asks_to_stop(double fraction, std::int64_t nodes) const {
    return monitor_ && monitor_(fraction, steps_done_, nodes, last_speeds_.max);
  }

  // converged, or stopped by the monitor
  Outcome initialise();
  Outcome step(std::int64_t n);
  Outcome run();
  PopulationCounts adjust_population();
  void rebalance();
  // Of a run from nothing; the nodes there are stay. Collective.
  Estimate estimate();

  // --- results; nodes are handed out in the order of their ids ---
  bool has_nodes() const { return level_ != nullptr; }
  std::int64_t count() const;         // of this rank
  std::int64_t global_count() const;  // collective
  const Level& level() const { return *level_; }
  // Memory index of each node in the order of ids, and the inverse. Preparing the lists (at their
  // extraction radius) or the stars prepares the order, too. The order alone changes nothing of
  // the level and may be asked for from a callback.
  void prepare_order();
  void prepare_lists();
  void prepare_stars();
  std::int64_t node_at(std::int64_t place) const { return by_id_[static_cast<std::size_t>(place)]; }
  std::int64_t place_of(std::int64_t node) const { return place_[static_cast<std::size_t>(node)]; }
  // Calls visit(place of i, place of j, place of k) for every triangle once, over all ranks: at the
  // owner of its node with the least id, which comes first. After prepare_stars.
  template <class Visit>
  void for_triangles(const Visit& visit) const {
    for_triangles(0, count(), visit);
  }
  // Only those whose first node has a place from begin up to end, by that place.
  template <class Visit>
  void for_triangles(std::int64_t begin, std::int64_t end, const Visit& visit) const;
  // Calls visit(place of begin, place of end, tag) for every boundary edge once, over all ranks: at
  // the owner of the node it begins with; the other may be a ghost. After prepare_order.
  template <class Visit>
  void for_boundary_edges(const Visit& visit) const;
  // In places. Collective.
  ExchangePattern exchange_pattern();
  std::int64_t nodes_on_ranks_before() const;
  // d by its values at this rank's nodes, in places. Collective.
  std::shared_ptr<const Spacing<2>> spacing_from(std::vector<double> values);
  const std::vector<std::string>& warnings() const { return warnings_; }

  // --- statistics ---
  const Timers& timers() const { return timers_; }
  const Communicator& communicator() const { return *comm_; }
  const std::shared_ptr<const Communicator>& ranks() const { return comm_; }
  std::int64_t steps_done() const { return steps_done_; }  // on all levels
  int coarser_levels() const { return coarser_levels_; }
  std::int64_t rebuilds() const {
    return rebuilds_before_ + (level_ ? level_->neighbourhood.rebuilds() : 0);
  }
  std::int64_t rebalances() const { return rebalances_before_ + (level_ ? level_->rebalances : 0); }
  std::int64_t inserted() const { return inserted_; }
  std::int64_t deleted() const { return deleted_; }
  std::int64_t dropped() const { return dropped_; }
  StopReason stop_reason() const { return stop_reason_; }
  Speeds speeds() const { return level_ ? speeds_of(*level_) : Speeds{}; }
  NearestNeighbourError spacing_error();
  // Of the triangles of the stars, and their edges. Collective.
  const ElementQuality& element_quality();
  std::uint64_t hash() const;

 private:
  Outcome prepare_level();
  Outcome make_level();
  Settings settings_for_new_level() const;
  std::shared_ptr<const Spacing<2>> bounded_spacing() const;
  std::shared_ptr<const Spacing<2>> growth_limited(std::shared_ptr<const Spacing<2>> spacing,
                                                   const Settings& settings);
  std::shared_ptr<const Spacing<2>> growth_limited(std::shared_ptr<const Spacing<2>> spacing,
                                                   const Settings& settings,
                                                   const std::function<void()>& beat) const;
  static bool too_steep(const SteepestGrowth& steepest);
  static std::string warning_of_growth(const SteepestGrowth& steepest, double growth_limit);
  double estimated_nodes(const Settings& settings) const;
  double bytes_allowed() const;
  std::unique_ptr<Level> empty_level(std::shared_ptr<const Spacing<2>> spacing,
                                     const Settings& settings, const Level* like = nullptr);
  void adopt_level(std::unique_ptr<Level> next);
  void forget_results() {
    order_version_ = lists_version_ = stars_version_ = quality_version_ = -1;
  }
  int coarser_levels_that_pay(const Level& finest,
                              const std::shared_ptr<const Spacing<2>>& spacing) const;
  bool boundary_leaves_room(const Spacing<2>& coarser, double boundary_nodes, double nodes) const;
  GivenNodes nodes_from_coarser_levels(const Level& finest,
                                       const std::shared_ptr<const Spacing<2>>& spacing,
                                       const Settings& settings, Outcome& outcome);
  void require_same_options() const;
  void require_same_domain() const;
  template <class Work>
  auto while_moving(const Work& work);
  void begin_schedule(bool refined);
  // Shares of a run's work, for its progress: coarser levels, and steps without the finish.
  static constexpr double kCoarseShare = 0.5, kStepsShare = 0.9;
  bool bubbles_rest() const;
  Outcome advance(std::int64_t until, ProgressPart part);
  void event();
  void control_population();
  void keep_balance();
  void rebalance_now();
  bool far_too_few() const;
  bool monitor_stops(double fraction);
  bool monitor_stops_by_clock(double fraction);
  bool stops_between_events(double fraction);
  bool monitor_is_due() const;
  void fill(Level& level);
  void while_monitored(const std::string& what,
                       const std::function<void(const std::function<void()>& beat)>& work);
  void repair_defects();
  Outcome finish();
  bool spacing_missed();
  PopulationCounts count_population_change(PopulationCounts change);

  std::shared_ptr<const Communicator> comm_;
  std::shared_ptr<PlaneDomain> domain_;
  Options options_;
  std::shared_ptr<const Spacing<2>> spacing_;
  Monitor monitor_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_asked_ = Clock::now();  // of the monitor
  std::unique_ptr<Level> level_;
  GivenNodes given_;  // nodes to start from instead of a fill
  bool start_from_given_ = false;
  bool spacing_replaced_ = false;  // since the level was made

  int coarser_levels_ = 0;  // that the nodes came from
  Schedule schedule_;       // of the level there is
  Speeds last_speeds_;
  std::int64_t steps_done_ = 0, inserted_ = 0, deleted_ = 0, dropped_ = 0, rebuilds_before_ = 0,
               rebalances_before_ = 0;
  StopReason stop_reason_ = StopReason::none;
  std::vector<std::string> warnings_;
  std::size_t warnings_of_level_ = 0;  // the first of them; the others are of the last run
  Timers timers_;

  // Versions of the level for which these were prepared last.
  std::int64_t order_version_ = -1, lists_version_ = -1, stars_version_ = -1, quality_version_ = -1;
  std::vector<std::int32_t> by_id_, place_;
  std::vector<EdgeBand> edge_bands_;  // of the level's finish
  ElementQuality quality_;
};

template <class Visit>
void Placement::for_triangles(std::int64_t begin, std::int64_t end, const Visit& visit) const {
  const View<std::int64_t> id = level_->nodes.id;
  for (std::int64_t p = begin; p < end; ++p) {
    const std::int64_t i = node_at(p);
    level_->stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
      const std::int64_t j = others[0], k = others[1];
      if (id(i) < id(j) && id(i) < id(k)) visit(p, place_of(j), place_of(k));
    });
  }
}

template <class Visit>
void Placement::for_boundary_edges(const Visit& visit) const {
  const Boundary& boundary = level_->ground.boundary();
  const Nodes<2>& nodes = level_->nodes;
  std::vector<std::int64_t> place(boundary.nodes.size(), -1);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (!nodes.moves(i)) place[static_cast<std::size_t>(nodes.boundary_node(i))] = place_of(i);
  const std::int64_t owned = count();
  for (const BoundaryEdge& e : boundary.facets) {
    if (e.begin == e.end) continue;  // a fixed node
    const std::int64_t begin = place[static_cast<std::size_t>(e.begin)];
    if (begin >= 0 && begin < owned) visit(begin, place[static_cast<std::size_t>(e.end)], e.tag);
  }
}

}  // namespace pnpbs
