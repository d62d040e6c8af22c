// SPDX-License-Identifier: BSD-3-Clause
// One level of the simulation: a spacing, the boundary laid at it, the background tree, the nodes
// and all that is found from them. The operations are the steps of the method; when they happen
// is the placement's business.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include "base/timers.hpp"
#include "comm/communicator.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "domain/domain_map.hpp"
#include "domain/plane/incident_sectors.hpp"
#include "domain/plane/plane_domain.hpp"
#include "dynamics/schemes.hpp"
#include "initial/given_nodes.hpp"
#include "initial/initial_fill.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/boundary_visibility.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"
#include "partition/distribution.hpp"
#include "partition/halo_exchange.hpp"
#include "partition/known_region.hpp"
#include "partition/packed_node.hpp"
#include "population/population.hpp"
#include "quality/element_quality.hpp"
#include "settings/settings.hpp"
#include "spacing/spacing.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// What became of given nodes, on all ranks.
struct TakenNodes {
  std::int64_t left_out = 0;  // outside, or too close to the boundary
  std::int64_t thinned = 0;   // too dense for d
  std::int64_t numbered = 0;  // those that came without an id
};

struct PopulationCounts {
  std::int64_t inserted = 0;
  std::int64_t deleted = 0;
};

struct SpacingVariation {
  double least = kFarAway, largest = 0;
  double steepest = 0;  // growth of d per unit of length
};

struct Speeds {
  double largest = 0, mean = 0;  // scaled: spacings per unit of time
};

class Level {
 public:
  Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const PlaneDomain> domain,
        std::shared_ptr<const Spacing<2>> spacing, const Settings& settings, Timers& timers);

  // --- making the level ---
  void discretize_boundary();
  // And deals it out to the ranks: over several of them, and where that balances the work, as
  // another level is dealt out whose spacing is a multiple of this one's.
  void grow_tree(const Level* like = nullptr);
  // Inner nodes from nothing. Calls beat() again and again: if it throws on one rank, all throw.
  void fill(const std::function<void()>& beat = [] {});
  // Or these, wherever they are; ids from next_id on are free.
  TakenNodes take(GivenNodes given, std::int64_t next_id);
  // For the steps to come; the growth limit belongs to the spacing and is not among them.
  void change_settings(const Settings& settings);

  // --- the time loop ---
  bool lists_need_rebuild() const;
  void rebuild_lists();
  void step();
  // A step is over, done or not: where one rank fails, all must count alike.
  void count_step() {
    ghosts_exact_ = false;
    ++steps_since_choice_;
  }
  // Where ranks agree: at the beginning of a row of steps, and once in a while within it. A failure
  // of this rank so far is told then.
  void exchange_for_steps(std::exception_ptr& failure);
  void exchange_for_stars();
  void exchange_for_runge_kutta() { exchange(hops_for(kRungeKuttaStages)); }
  void finish_by_runge_kutta();

  // --- events ---
  void refresh_spacing();
  // By the thresholds of the settings and, where the mean distance is off by more than the
  // tolerance, by those that it asks for. Collective.
  PopulationCounts adjust_population(double tolerance = kMeanTolerance);
  // Deletes and inserts where defects of the Delaunay stars are repaired by it. Collective.
  PopulationCounts repair_defects();
  Speeds speeds() const;
  // Deals the tree out anew by the work counted. Collective.
  void rebalance();
  void renew_stars();
  // At the end of a run, before its sweeps: nodes go that have no room. Collective.
  PopulationCounts remove_crowded();
  // On the Delaunay stars: finishing sweeps, and the repair of defects by the settings' rule.
  PopulationCounts sweep_and_repair(std::int64_t sweeps);
  // Edge length over d, as the last of these found it: with its stars, and d from before it.
  const std::vector<EdgeBand>& edge_bands() const { return edge_bands_; }

  // --- for extraction: lists with this radius, fresh at the present positions ---
  void rebuild_lists(double radius);
  // The lists handed out. Over several ranks with the ghosts that the stars need, and the stars.
  void prepare_lists();

  const Nodes<2>& nodes() const { return nodes_; }
  const PlaneDomain& domain() const { return *domain_; }
  const Boundary& boundary() const { return boundary_; }
  const DomainMap& map() const { return map_; }
  const AdjacencyList<2>& lists() const { return lists_; }
  const DelaunayStars& stars() const { return stars_; }
  const NearEdges& near_edges() const { return near_edges_; }
  const Settings& settings() const { return settings_; }
  std::int64_t next_id() const { return next_id_; }
  // Changes whenever nodes move, in space or in memory.
  std::int64_t version() const { return version_; }
  // Nodes that the spacing asks for.
  double expected_nodes() const;
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t rebalances() const { return rebalances_; }
  // Of this rank: ranks it exchanges ghosts with, and what it sends when they are renewed.
  std::int64_t neighbour_ranks() const { return plan_.neighbour_count(); }
  std::int64_t renewal_bytes() const {
    return plan_.nodes_sent() * static_cast<std::int64_t>(HaloExchange<2>::kRecordSize);
  }
  // Of this rank, as counted after the last event: listed pairs, and as many again per node.
  std::int64_t owned_work() const { return owned_work_; }
  // Largest over mean of that; collective.
  double imbalance() const;
  std::int64_t boundary_nodes() const { return static_cast<std::int64_t>(boundary_.nodes.size()); }
  GivenNodes owned_nodes() const;
  // What a level of another spacing begins with: the nodes of this rank and, where that is finer,
  // new ones on the edges of their stars and in their triangles: where it is half of the present
  // one, in the middle of every edge. Collective.
  GivenNodes refined(const Spacing<2>& next);
  // By the samples of d in the leaves. Collective.
  SpacingVariation spacing_variation() const;
  SteepestGrowth steepest_growth() const;  // collective
  std::int64_t owned_count() const;
  // Rank that owns a node (this one's own and ghosts).
  int owner_of(std::int64_t i) const {
    return distributed() ? distribution_.owner_at(nodes_.position(i)) : 0;
  }
  bool distributed() const { return comm_->size() > 1; }

 private:
  // In hops of the lists: a candidate is judged by its list, looks two hops far for room, and may
  // not act if a stronger one is within three. A hop of the leaf graph is the longer one.
  static constexpr int kPopulationHops = 6;
  // For the stars of our nodes and their neighbours, and for lists of any radius, where d is even;
  // what they need farther away is asked for.
  static constexpr int kStarHops = 3;
  // The same for the stars that sweeps and repairs look at, some neighbours farther away.
  static constexpr int kRepairHops = 4;
  static constexpr int kRungeKuttaStages = 4;
  static constexpr double kWorkPerNode = 16;  // in estimates

  SpacingEvaluator evaluator() const;

  // --- the partition ---
  void require_same_ground(const PartitionCells<2>& cells) const;
  void require_same_leaves() const;
  void look_at_new_tree();
  void forget_what_goes_by_leaves();
  std::vector<PartitionCell<2>> rough_cells();
  std::vector<std::int64_t> expected_work() const;
  void refine_tree(const std::vector<char>& refined);
  void link_leaves();
  void grow_own_part();
  std::function<bool(std::int32_t)> owns_leaf() const;
  LeafFunctions leaf_functions(std::vector<std::int64_t> work) const;
  void take_rough_cells();
  std::vector<std::int32_t> cut_on_first_rank(const PartitionCells<2>& cells) const;
  std::vector<std::int32_t> cut_like(const Distribution<2>& other,
                                     const PartitionCells<2>& cells) const;
  std::int64_t node_work(std::int64_t i) const;
  std::vector<std::int64_t> counted_work() const;
  std::vector<std::int32_t> keep_numbers(const PartitionCells<2>& cells,
                                         std::vector<std::int32_t> part,
                                         const std::vector<std::int64_t>& work) const;
  void adopt(Distribution<2> next);
  void count_work();

  // --- exchange ---
  int hops_for(std::int64_t evaluations) const;
  int step_hops() const;
  int deepest_hops() const;
  const Halo& halo_of(int hops);
  std::int64_t ghost_life() const;
  bool ghosts_can_stay(int hops) const;
  void renew_ghosts();
  void exchange(int hops);
  void migrate();

  double widest_radius() const;
  double meeting_radius() const;
  double edge_radius() const;
  View<double> spacing_at_owned_nodes(const Spacing<2>& spacing) const;
  // d at an owned node; its bubble on a fine boundary is smaller.
  double spacing_asked_at(std::int64_t i) const {
    return nodes_.moves(i) ? nodes_.d(i)
                           : boundary_spacing_[static_cast<std::size_t>(nodes_.boundary_node(i))];
  }
  bool on_one_edge(std::int64_t i, std::int64_t j) const;
  template <class Visit>
  void for_new_nodes(std::int64_t i, double d, const Visit& visit) const;
  std::vector<Point<2>> graded_fill(const std::function<bool(std::int32_t)>& owned) const;
  void leave_out_coinciding(GivenNodes& inner) const;
  void number_and_store(GivenNodes inner);
  void scatter_to_owners(GivenNodes& given) const;
  std::vector<double> wanted_nodes() const;
  std::vector<LeafSummary> summaries_of_unrefined_leaves() const;
  void find_leaves(GivenNodes& given) const;
  void leave_out_those_without_place(GivenNodes& given) const;
  bool has_place(const GivenNode& node) const;
  std::vector<std::int32_t> sort_by_place(GivenNodes& given) const;
  void thin(GivenNodes& inner, const std::vector<std::int32_t>& begin) const;
  void keep_boundary_ids(const GivenNodes& given);
  void make_lists_and_stars(int hops, double radius, int rings);
  void make_stars(int hops, double radius, int rings);
  KnownRegion<2> known_after_exchange(int hops);
  std::vector<Box<2>> unknown_around_stars(int rings) const;
  std::vector<std::int64_t> neighbours_of(const std::vector<std::int64_t>& front,
                                          std::vector<char>& reached) const;
  void fetch_nodes_in(const std::vector<Box<2>>& boxes);
  Bytes nodes_for(const Message& asked);
  PopulationCounts carry_out(PopulationChange<2> change);
  void number_births(std::vector<Birth<2>> born);
  void sweep_over_stars(std::int64_t times);
  void repair_bad_triangles();
  void repair_triangles_below(double shape);
  void delete_nodes(const std::vector<std::int32_t>& deleted);
  void keep_nodes(const View<std::int32_t>& places, std::int64_t kept);
  bool has_clearance(const Point<2>& x, double d) const;
  bool between_edges(std::int64_t i) const;
  template <class Visit>
  void for_coinciding(std::int64_t i, const Visit& visit) const;
  View<char> nodes_without_room() const;
  std::vector<std::int32_t> crowded_nodes() const;
  void prepare_finish();
  void find_edge_bands();
  void accept_step();
  void hold_off_boundary(std::int64_t i) const;
  double largest_way(std::int64_t first, std::int64_t last) const;
  void rebuild_lists(double radius, const Field<2>& seen_from);
  void set_reference_positions();
  void set_padding();
  template <class Law>
  void move_by(const Law& law, bool runge_kutta);

  std::shared_ptr<const Communicator> comm_;
  std::shared_ptr<const PlaneDomain> domain_;
  std::shared_ptr<const Spacing<2>> spacing_;
  Settings settings_;
  Timers& timers_;

  Boundary boundary_;
  IncidentSectors sectors_;
  DomainMap map_;
  std::vector<std::int64_t> boundary_ids_;  // of the boundary nodes, -1 until numbered
  std::vector<double> boundary_bound_;      // of their bubbles: see bubbles_on_boundary
  std::vector<double> boundary_spacing_;    // d there, as it was asked
  Nodes<2> nodes_;
  std::int64_t next_id_ = 0;

  std::shared_ptr<const LeafLinks<2>> links_;  // leaves of which one reaches the other
  Distribution<2> distribution_;
  int tree_hops_ = 0;  // the tree is refined so far around the leaves we own
  HaloExchange<2> plan_;
  int ghost_hops_ = 0;         // ghosts reach so far; 0: they must be chosen anew
  bool ghosts_exact_ = false;  // nothing has moved since they came
  std::int64_t steps_since_choice_ = 0;
  std::int64_t owned_work_ = 0, rebalances_ = 0;
  bool work_is_old_ = true;  // counted once after every event

  Buckets<2> buckets_;
  NearEdges near_edges_;
  BoundaryVisibility boundary_visibility_;
  AdjacencyList<2> lists_;
  DelaunayStars stars_;
  std::vector<EdgeBand> edge_bands_;
  KnownRegion<2> known_;  // while stars are made: where all nodes are known

  Field<2> next_;    // positions after the move in progress
  Field<2> listed_;  // positions at which the lists were made
  Stages<2> stages_;
  double max_displacement_ = 0;  // largest way of a node since then, in units of its d
  bool lists_valid_ = false;
  std::int64_t rebuilds_ = 0;
  std::int64_t version_ = 0;
  std::int64_t prepared_ = -1;  // version when lists were made for the finish
};

}  // namespace pnpbs
