// SPDX-License-Identifier: BSD-3-Clause
// Results that do not depend on the dimension: the nodes in the order of results, figures, and
// fields of values. Results<Dim> has the rest.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/geometry_kind.hpp"
#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"
#include "comm/ghost_sum.hpp"
#include "comm/ghost_update.hpp"
#include "level/finish.hpp"
#include "level/level_stamp.hpp"
#include "level/speeds.hpp"

namespace pnpbs {

// The attributes of the nodes of a rank, in the order of memory.
struct NodeColumns {
  std::int64_t count = 0;
  std::array<View<const double>, 3> x;  // of these, coordinates() are set
  View<const double> d;
  View<const std::int64_t> id;
  View<const std::int32_t> tag;
  View<const char> owned;
};

// Figures of the present level on this rank.
struct LevelFigures {
  std::int64_t neighbour_ranks = 0;
  std::int64_t exchange_bytes = 0;
  std::int64_t owned_work = 0;
  std::int64_t rebuilds = 0, rebalances = 0;
  std::int64_t left_out = 0;
};

// Statistics of the nearest-neighbour distance over d.
struct NearestNeighbourError {
  double mean = 0, deviation = 0, min = 0;
};

// The results of a level that any dimension has. Results have an order of their own: a *result
// index* numbers the owned nodes by id, and then the ghosts by id.
class NodalResults {
 public:
  explicit NodalResults(std::shared_ptr<const Communicator> comm) : comm_(std::move(comm)) {}
  virtual ~NodalResults() = default;
  NodalResults(const NodalResults&) = delete;
  NodalResults& operator=(const NodalResults&) = delete;

  // Returns the dimension of what the nodes fill. It is 2 on a sphere.
  virtual int dimension() const = 0;
  virtual int coordinates() const = 0;  // number of coordinates of a returned node
  virtual GeometryKind kind() const = 0;
  virtual double sphere_radius() const = 0;  // 0 if the domain is not on a sphere
  const Communicator& communicator() const { return *comm_; }
  const std::shared_ptr<const Communicator>& ranks() const { return comm_; }

  // --- nodes, in the order of results ---
  virtual bool has_nodes() const = 0;
  virtual std::int64_t count() const = 0;  // number of owned nodes
  std::int64_t global_count() const;       // collective
  virtual std::int64_t held() const = 0;   // number of nodes on this rank, including ghosts
  virtual NodeColumns nodes() const = 0;   // all nodes on this rank, in the order of memory
  // Prepare the order of results, the adjacency lists (with the radius for extraction) or the
  // stars. Each of the latter two also prepares the order. The order does not change the level, so
  // a callback may request it. The other two are collective; if one rank throws, all ranks throw.
  virtual void prepare_order() = 0;
  virtual void prepare_lists() = 0;
  virtual void prepare_stars() = 0;
  // Restores agreement after a call that has failed on all ranks: if some ranks have derived data,
  // such as lists, that others lack, all ranks release the derived data. Collective.
  virtual void agree_on_derived() noexcept = 0;
  // Convert a result index to a memory index, and back. Require prepare_order().
  std::int64_t node_at(std::int64_t place) const { return by_id_[static_cast<std::size_t>(place)]; }
  std::int64_t place_of(std::int64_t node) const { return place_[static_cast<std::size_t>(node)]; }
  // Returns the pattern of the ghost exchange, in result indices. It is the same object until nodes
  // move or lists are rebuilt. All ranks must call it, and if one rank throws, all ranks throw.
  virtual std::shared_ptr<const ExchangePattern> exchange_pattern() = 0;
  std::int64_t nodes_on_ranks_before() const;

  // --- cracks ---
  // Sets the tags of the inner curves or surfaces that are cracks. Local.
  void set_crack_tags(std::vector<std::int32_t> tags) {
    crack_tags_ = std::move(tags);
    cracks_stamp_ = LevelStamp();
  }
  const std::vector<std::int32_t>& crack_tags() const { return crack_tags_; }

  // --- fields: arrays [result index][components], ghosts included ---
  // Starts to send the values of owned nodes to their ghosts. n must be held(). All ranks must call
  // it, and if one rank throws, all ranks throw.
  void begin_ghost_update(std::int64_t n, std::int64_t components, const double* values);
  // Waits for the values that other ranks have sent, and stores them at the ghosts. Local.
  void end_ghost_update(std::int64_t n, std::int64_t components, double* values);
  // Adds the values of ghosts to those of the nodes that they copy. All ranks must call it, and if
  // one rank throws, all ranks throw.
  void add_from_ghosts(std::int64_t n, std::int64_t components, double* values);
  // Computes for each component the exact sum, over the owned nodes of all ranks, of the values or
  // of the products of two fields, and rounds it once. All ranks must call them, and if one rank
  // throws, all ranks throw.
  void sum(std::int64_t n, std::int64_t components, const double* values, double* sums);
  void dot(std::int64_t n, std::int64_t components, const double* x, const double* y,
           double* products);

  // --- figures ---
  virtual LevelFigures level_figures() const = 0;
  virtual Speeds speeds() const = 0;
  virtual std::int64_t boundary_nodes() const = 0;  // on all ranks; collective
  virtual double imbalance() const = 0;             // collective
  virtual NearestNeighbourError spacing_error() = 0;
  // Returns the quality of the elements of the stars and of their edges. All ranks must call it,
  // and if one rank throws, all ranks throw.
  virtual const ElementQuality& element_quality() = 0;
  virtual std::uint64_t hash() const = 0;

 protected:
  // Returns the stamp of the present level.
  virtual LevelStamp stamp() const = 0;

  std::shared_ptr<const Communicator> comm_;
  // The stamps for which each kind of data was prepared last.
  LevelStamp order_stamp_, lists_stamp_, stars_stamp_, quality_stamp_, exchange_stamp_,
      cracks_stamp_;
  std::vector<std::int32_t> crack_tags_;
  std::vector<std::int32_t> by_id_, place_;
  std::int64_t owned_in_order_ = 0;  // number of owned nodes at the beginning of by_id_
  std::shared_ptr<const ExchangePattern> exchange_pattern_;
  ElementQuality quality_;

 private:
  void require_result_indices(std::int64_t n) const;  // throws unless n is held()
  void require_owned(std::int64_t n) const;           // throws unless n is at least count()
  void gather_terms(std::int64_t components, const double* x, const double* y);
  void finish_sums(double* sums);

  GhostUpdate ghost_update_;
  GhostSum ghost_sum_;
  std::vector<std::int64_t> sum_entries_;  // of the sums in progress
};

}  // namespace pnpbs
