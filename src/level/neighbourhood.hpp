// SPDX-License-Identifier: BSD-3-Clause
// The neighbourhood of the nodes of a level: buckets, the boundary near nodes, and adjacency lists.
// All of it is derived from the nodes and the tree, and carries stamps of what it was derived from.
#pragma once

#include <cstdint>
#include <vector>

#include "base/timers.hpp"
#include "level/level_geometry.hpp"
#include "level/level_tree.hpp"
#include "level/near_boundary.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// The buckets, near boundary and lists of one level on this rank. All functions are local.
template <int Dim>
class Neighbourhood {
 public:
  // Adopts a new boundary.
  void reset_boundary(const LevelGeometry<Dim>& geometry) { near_boundary_.reset(geometry); }
  // Adopts a new tree, or another radius of what is near nodes. Lists must be rebuilt afterwards.
  void adopt(const LevelTree<Dim>& tree, typename NearBoundary<Dim>::NearLeaves near_leaves);
  // Returns whether adopt() was called with this tree and nothing was released since.
  bool is_for(const LevelTree<Dim>& tree) const { return prepared_for_ == &tree; }

  // Figures for statistics and for the test of the balance.
  struct Figures {
    std::int64_t rebuilds = 0, owned_work = 0;
    bool work_is_current = false;
  };
  Figures figures(const Nodes<Dim>& nodes) const {
    return {rebuilds_, owned_work_, work_counted_ == nodes.references()};
  }
  // Releases everything but these figures, because the nodes or the tree have changed. adopt() must
  // follow.
  void forget(const LevelTree<Dim>& tree, const Nodes<Dim>& nodes, const Figures& figures) noexcept;

  // Sorts the nodes in memory by bucket, which must precede every rebuild of lists. Returns whether
  // their order changed.
  bool sort_nodes(Nodes<Dim>& nodes, const LevelTree<Dim>& tree, const Settings& settings);
  // Builds lists for the time loop. Visibility is determined at the reference positions, so the
  // result does not depend on the time of the rebuild.
  void rebuild_for_steps(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                         const LevelTree<Dim>& tree, const Settings& settings, ListsOf listed);
  // Adds the lists of these nodes if only those of owned nodes were built.
  void add_lists(const Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                 const LevelTree<Dim>& tree, const std::vector<std::int32_t>& more);
  // Builds lists of this radius at the present positions. The next step then rebuilds its own
  // lists. Releases the positions that displacements are measured from and the spare arrays of the
  // nodes, because stars need the memory.
  void rebuild_here(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                    const LevelTree<Dim>& tree, double radius, ListsOf listed);
  // Releases the lists, which must be rebuilt before they are read again.
  void release_lists() noexcept;
  // Returns whether the lists for steps may lack a pair within the range of the force.
  bool needs_rebuild(const Nodes<Dim>& nodes, const Settings& settings) const;

  // Returns whether the lists were built with this radius at the present positions.
  bool built_here(const Nodes<Dim>& nodes, double radius) const {
    return !for_steps_ && arrangement_ == nodes.arrangement() && positions_ == nodes.positions() &&
           references_ == nodes.references() && lists_.radius() == radius;
  }

  // Returns the square of the largest displacement since the lists for steps were built, in units
  // of d, of the nodes in [first, last) for the positions x.
  double squared_displacement(const Nodes<Dim>& nodes, const Field<Dim>& x, std::int64_t first,
                              std::int64_t last) const;
  // Sets the largest displacement of all nodes.
  void set_max_displacement(double displacement) { max_displacement_ = displacement; }
  // Computes it for the present positions, after an update has moved ghosts.
  void measure_displacement(const Nodes<Dim>& nodes);

  // Keeps the nodes with these indices, in this order, and removes the others.
  void keep_nodes(Nodes<Dim>& nodes, const View<std::int32_t>& places, std::int64_t kept);
  // Returns an array in which the caller stores the bucket of each node, after all nodes were
  // replaced.
  View<std::int32_t>& reset_buckets(const Nodes<Dim>& nodes) {
    return buckets_.reset_buckets(nodes);
  }

  const Buckets<Dim>& buckets() const { return buckets_; }
  const NearBoundary<Dim>& near_boundary() const { return near_boundary_; }
  const AdjacencyList<Dim>& lists() const { return lists_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  ListsOf listed() const { return listed_nodes_; }
  NodesWorkedFor nodes_listed() const { return nodes_listed_; }

  // Returns the work of the owned nodes, in listed pairs plus a constant per node. It is counted
  // when lists are built for the first time after an event or after recount_work().
  std::int64_t owned_work() const { return owned_work_; }
  void recount_work() { work_counted_ = -1; }
  // Returns the work of one node.
  std::int64_t work_of(std::int64_t i) const;

 private:
  void rebuild(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry, const LevelTree<Dim>& tree,
               double radius, const Field<Dim>& seen_from, ListsOf listed);
  void count_work(const Nodes<Dim>& nodes);

  const LevelTree<Dim>* prepared_for_ = nullptr;
  Buckets<Dim> buckets_;
  NearBoundary<Dim> near_boundary_;
  AdjacencyList<Dim> lists_;
  std::int64_t rebuilds_ = 0;
  NodesWorkedFor nodes_listed_;  // in the last rebuild

  // Stamps of the nodes that the lists were built for; -1: they must be rebuilt.
  std::int64_t arrangement_ = -1, positions_ = -1, references_ = -1;
  bool for_steps_ = false;
  ListsOf listed_nodes_ = ListsOf::all_nodes;
  Field<Dim> listed_;  // positions at the rebuild, for lists for steps
  double max_displacement_ = 0;

  std::int64_t owned_work_ = 0, work_counted_ = -1;  // counted for these reference positions
};

}  // namespace pnpbs
