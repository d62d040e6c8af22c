// SPDX-License-Identifier: BSD-3-Clause
// One level of the simulation: a spacing, the boundary laid at it, the background tree, the nodes
// and all that is found from them. The operations are the steps of the method; when they happen
// is the placement's business.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/settings.hpp"
#include "core/timers.hpp"
#include "forces/schemes.hpp"
#include "geometry/boundary_fans.hpp"
#include "geometry/domain_map.hpp"
#include "geometry/plane_domain.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"
#include "parallel/communicator.hpp"
#include "parallel/distribution.hpp"
#include "parallel/known_region.hpp"
#include "spacing/spacing.hpp"
#include "stars/delaunay_stars.hpp"

namespace pnpbs {

// A node as it comes from outside or from an earlier level.
struct GivenNode {
  Point<2> position;
  std::int64_t id;    // -1: give it one
  bool inner = true;  // a boundary node is laid afresh; one that was there keeps its id
  double d = 0;       // spacing it was placed for; 0 if not known
};

// What became of given nodes, on all ranks.
struct TakenNodes {
  std::int64_t left_out = 0;  // outside, or too close to the boundary
  std::int64_t thinned = 0;   // too dense for d
};

struct PopulationCounts {
  std::int64_t inserted = 0;
  std::int64_t deleted = 0;
};

struct Speeds {
  double largest = 0, mean = 0;  // scaled: spacings per unit of time
};

class Level {
 public:
  Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const PlaneDomain> domain,
        std::shared_ptr<const Spacing<2>> spacing, const Settings& settings, Timers& timers);

  // --- making the level ---
  void lay_boundary_and_tree();
  void distribute();  // leaves to ranks
  void fill();        // inner nodes from nothing
  // Or these, wherever they are; ids from next_id on are free.
  TakenNodes take(std::vector<GivenNode> given, std::int64_t next_id);
  // For the steps to come; the growth limit belongs to the spacing and is not among them.
  void change_settings(const Settings& settings);

  // --- the time loop ---
  bool lists_may_miss_a_pair() const;
  void rebuild_lists();
  void move();
  // Owned nodes go to the ranks that own their leaves by now, and ghosts are renewed.
  void exchange_for_steps() { exchange(step_hops()); }
  void finish_by_runge_kutta();

  // --- events ---
  void refresh_spacing();
  // Inserts beside bubbles with an overlap ratio below the option's, or below `refill` if that is
  // more.
  PopulationCounts adjust_population(double refill = 0);
  Speeds speeds() const;
  void renew_stars();
  void sweep(std::int64_t times);

  // --- for extraction: lists with this radius, fresh at the present positions ---
  void rebuild_lists(double radius);
  // The lists handed out. Over several ranks with the ghosts that the stars need, and the stars.
  void prepare_lists();

  const Nodes<2>& nodes() const { return nodes_; }
  const Boundary& boundary() const { return boundary_; }
  const DomainMap& map() const { return map_; }
  const AdjacencyList<2>& lists() const { return lists_; }
  const DelaunayStars& stars() const { return stars_; }
  const Settings& settings() const { return settings_; }
  std::int64_t next_id() const { return next_id_; }
  // Changes whenever nodes move, in space or in memory.
  std::int64_t version() const { return version_; }
  // Nodes that the spacing asks for.
  double expected_nodes() const;
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t boundary_nodes() const { return static_cast<std::int64_t>(boundary_.nodes.size()); }
  std::vector<GivenNode> owned_nodes() const;
  std::int64_t owned_count() const;
  // Rank that owns a node (this one's own and ghosts).
  int owner_of(std::int64_t i) const {
    return distributed() ? distribution_.owner(map_.tree().leaf_at(nodes_.position(i))) : 0;
  }
  bool distributed() const { return comm_->size() > 1; }

 private:
  // In hops of the lists: a candidate for population control is judged by its list, looks two hops
  // far for room, and may not act if a stronger one is within three. A hop of the leaf graph is the
  // longer one.
  static constexpr int kPopulationHops = 6;
  // Five sweeps on fixed stars, each with a guard that looks at the neighbours' moves. Enough where
  // d is even; what lies farther is asked for.
  static constexpr int kSweepHops = 6;

  SpacingEvaluator evaluator() const;
  double widest_radius() const;
  double edge_radius() const;
  void number_and_store(std::vector<GivenNode> inner);
  void scatter_to_owners(std::vector<GivenNode>& given) const;
  std::vector<double> wanted_nodes() const;
  void thin(std::vector<GivenNode>& inner) const;
  void keep_boundary_ids(const std::vector<GivenNode>& given);
  int step_hops() const;
  void exchange(int hops);
  void make_lists_and_stars(int hops, double radius, int rings);
  KnownRegion known_after_exchange(int hops);
  std::vector<Box<2>> unknown_around_stars(int rings) const;
  void fetch_nodes_in(const std::vector<Box<2>>& boxes);
  Bytes owned_nodes_in(const Bytes& asked) const;
  void number_births(std::vector<Birth<2>> born);
  bool fits(const Point<2>& x, double d) const;
  bool has_no_room(std::int64_t i) const;
  void take_next_positions();
  void rebuild_lists(double radius, const Field<2>& seen_from);
  void drop_anchors();
  void set_padding();
  template <class Law>
  void move_by(const Law& law, bool runge_kutta);

  std::shared_ptr<const Communicator> comm_;
  std::shared_ptr<const PlaneDomain> domain_;
  std::shared_ptr<const Spacing<2>> spacing_;
  Settings settings_;
  Timers& timers_;

  Boundary boundary_;
  BoundaryFans fans_;
  DomainMap map_;
  std::vector<std::int64_t> boundary_ids_;  // of the boundary nodes, -1 until numbered
  Nodes<2> nodes_;
  std::int64_t next_id_ = 0;

  LeafGraph<2> interaction_;  // of the leaves, the same on every rank
  Distribution distribution_;

  Buckets<2> buckets_;
  NearEdges near_edges_;
  AdjacencyList<2> lists_;
  DelaunayStars stars_;
  KnownRegion known_;  // while stars are made: where all nodes are known

  Field<2> next_;    // positions after the move in progress
  Field<2> listed_;  // positions at which the lists were made
  Stages<2> stages_;
  double travelled_ = 0;  // largest way of a node since then, in units of its d
  bool lists_valid_ = false;
  std::int64_t rebuilds_ = 0;
  std::int64_t version_ = 0;
};

}  // namespace pnpbs
