// SPDX-License-Identifier: BSD-3-Clause
// Nodes as they are handed out, figures of them, and fields of values at them: what is the same in
// any dimension. Results<Dim> is the rest of it.
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

// The nodes of a rank, as they lie in memory.
struct NodeColumns {
  std::int64_t count = 0;
  std::array<View<const double>, 3> x;  // as many as there are coordinates
  View<const double> d;
  View<const std::int64_t> id;
  View<const std::int32_t> tag;
  View<const char> owned;
};

// Of the level there is, on this rank.
struct LevelFigures {
  std::int64_t neighbour_ranks = 0;
  std::int64_t exchange_bytes = 0;
  std::int64_t owned_work = 0;
  std::int64_t rebuilds = 0, rebalances = 0;
  std::int64_t left_out = 0;
};

struct NearestNeighbourError {
  double mean = 0, deviation = 0, min = 0;  // of nearest-neighbour distance over d
};

class NodalResults {
 public:
  explicit NodalResults(std::shared_ptr<const Communicator> comm) : comm_(std::move(comm)) {}
  virtual ~NodalResults() = default;
  NodalResults(const NodalResults&) = delete;
  NodalResults& operator=(const NodalResults&) = delete;

  // Of what the nodes fill; a sphere is filled like the plane.
  virtual int dimension() const = 0;
  virtual int coordinates() const = 0;  // of a node, as they are handed out
  virtual GeometryKind kind() const = 0;
  virtual double sphere_radius() const = 0;  // 0 if the domain is not on a sphere
  const Communicator& communicator() const { return *comm_; }
  const std::shared_ptr<const Communicator>& ranks() const { return comm_; }

  // --- nodes, handed out in the order of their ids ---
  virtual bool has_nodes() const = 0;
  virtual std::int64_t count() const = 0;  // of this rank
  std::int64_t global_count() const;       // collective
  virtual std::int64_t held() const = 0;   // on this rank, ghosts among them
  virtual NodeColumns nodes() const = 0;   // as they lie in memory, all that are held
  // Memory index of each node in the order of ids, and the inverse. Preparing the lists (at their
  // extraction radius) or the stars prepares the order, too. The order alone changes nothing of
  // the level and may be asked for from a callback.
  virtual void prepare_order() = 0;
  virtual void prepare_lists() = 0;
  virtual void prepare_stars() = 0;
  // After a call that has failed on all ranks: if some have derived from the nodes what others have
  // not, such as lists, all forget it, so that they agree when it is requested again. Collective.
  virtual void agree_on_derived() noexcept = 0;
  std::int64_t node_at(std::int64_t place) const { return by_id_[static_cast<std::size_t>(place)]; }
  std::int64_t place_of(std::int64_t node) const { return place_[static_cast<std::size_t>(node)]; }
  // In places; the same object until nodes move or lists are made. Collective.
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

  // --- figures ---
  virtual LevelFigures level_figures() const = 0;
  virtual Speeds speeds() const = 0;
  virtual std::int64_t boundary_nodes() const = 0;  // of all ranks; collective
  virtual double imbalance() const = 0;             // collective
  virtual NearestNeighbourError spacing_error() = 0;
  // Of the simplices of the stars, and their edges. Collective.
  virtual const ElementQuality& element_quality() = 0;
  virtual std::uint64_t hash() const = 0;

 protected:
  // Of the level there is.
  virtual LevelStamp stamp() const = 0;

  std::shared_ptr<const Communicator> comm_;
  // For which these were prepared last.
  LevelStamp order_stamp_, lists_stamp_, stars_stamp_, quality_stamp_, exchange_stamp_;
  std::vector<std::int32_t> by_id_, place_;
  std::int64_t owned_in_order_ = 0;  // of by_id_, the first ones
  std::shared_ptr<const ExchangePattern> exchange_pattern_;
  ElementQuality quality_;

 private:
  void require_places(std::int64_t n) const;  // of all nodes and ghosts
  void require_owned(std::int64_t n) const;   // of all nodes at least
  void gather_terms(std::int64_t components, const double* x, const double* y);
  void finish_sums(double* sums);

  GhostUpdate ghost_update_;
  GhostSum ghost_sum_;
  std::vector<std::int64_t> sum_entries_;  // of the sums in progress, on their way over the ranks
};

}  // namespace pnpbs
