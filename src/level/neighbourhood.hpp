// SPDX-License-Identifier: BSD-3-Clause
// What is near the nodes of a level: buckets, the boundary near nodes, adjacency lists. All
// of it is derived from the nodes and the tree, and stamped with what it was derived from.
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

template <int Dim>
class Neighbourhood {
 public:
  // A new boundary.
  void reset_boundary(const LevelGeometry<Dim>& geometry) { near_boundary_.reset(geometry); }
  // For another tree, or another radius of what is near nodes.
  void adopt(const LevelTree<Dim>& tree, typename NearBoundary<Dim>::NearLeaves near_leaves);
  // Are the nodes and the tree others since then?
  bool is_for(const LevelTree<Dim>& tree) const { return prepared_for_ == &tree; }

  // What statistics tell of the lists, and what the partition is judged by.
  struct Figures {
    std::int64_t rebuilds = 0, owned_work = 0;
    bool work_is_current = false;
  };
  Figures figures(const Nodes<Dim>& nodes) const {
    return {rebuilds_, owned_work_, work_counted_ == nodes.references()};
  }
  // Forgets everything but these figures: the nodes or the tree are others. adopt() comes next.
  void forget(const LevelTree<Dim>& tree, const Nodes<Dim>& nodes, const Figures& figures) noexcept;

  // Sorts the nodes in memory by bucket; returns whether they changed their places. First of all
  // before lists are made.
  bool sort_nodes(Nodes<Dim>& nodes, const LevelTree<Dim>& tree, const Settings& settings);
  // Lists for the time loop: visibility is judged from the reference positions, so that it does not
  // matter when they are made.
  void rebuild_for_steps(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                         const LevelTree<Dim>& tree, const Settings& settings, ListsOf listed);
  // The lists of these nodes, too, where only those of owned nodes were made.
  void add_lists(const Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                 const LevelTree<Dim>& tree, const std::vector<std::int32_t>& more);
  // Lists of that radius for where the nodes are. The next step makes its own again; until then
  // there are stars, and no need to know where nodes were: the two take their memory in turn.
  void rebuild_here(Nodes<Dim>& nodes, const LevelGeometry<Dim>& geometry,
                    const LevelTree<Dim>& tree, double radius, ListsOf listed);
  // Might the lists for steps lack a pair within the range of the force?
  bool needs_rebuild(const Nodes<Dim>& nodes, const Settings& settings) const;

  // Were the lists made with that radius for where the nodes are?
  bool made_here(const Nodes<Dim>& nodes, double radius) const {
    return !for_steps_ && arrangement_ == nodes.arrangement() && positions_ == nodes.positions() &&
           references_ == nodes.references() && lists_.radius() == radius;
  }

  // The largest displacement since the lists for steps were made, in units of d, of the nodes from
  // `first` up to `last` if they were at x; squared.
  double squared_displacement(const Nodes<Dim>& nodes, const Field<Dim>& x, std::int64_t first,
                              std::int64_t last) const;
  // The largest one so far, of all nodes.
  void set_max_displacement(double displacement) { max_displacement_ = displacement; }
  // Finds it, as the update of ghosts moves them, too.
  void measure_displacement(const Nodes<Dim>& nodes);

  // Nodes come and go: those named stay, in this order.
  void keep_nodes(Nodes<Dim>& nodes, const View<std::int32_t>& places, std::int64_t kept);
  // New nodes instead of all: the bucket of each is to be written.
  View<std::int32_t>& buckets_of_new(const Nodes<Dim>& nodes) {
    return buckets_.buckets_of_new(nodes);
  }

  const Buckets<Dim>& buckets() const { return buckets_; }
  const NearBoundary<Dim>& near_boundary() const { return near_boundary_; }
  const AdjacencyList<Dim>& lists() const { return lists_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  ListsOf listed() const { return listed_nodes_; }
  NodesWorkedFor nodes_listed() const { return nodes_listed_; }

  // Of owned nodes: listed pairs, and as much again for each node as it costs besides. Counted when
  // lists are made for the first time after an event, or after this.
  std::int64_t owned_work() const { return owned_work_; }
  void recount_work() { work_counted_ = -1; }
  // The same of one node.
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
  NodesWorkedFor nodes_listed_;  // when they were made last

  // What the lists were made of: stamps of the nodes; -1: they must be made anew.
  std::int64_t arrangement_ = -1, positions_ = -1, references_ = -1;
  bool for_steps_ = false;
  ListsOf listed_nodes_ = ListsOf::all_nodes;
  Field<Dim> listed_;  // if they are for steps: positions at which they were made
  double max_displacement_ = 0;

  std::int64_t owned_work_ = 0, work_counted_ = -1;  // for these reference positions
};

}  // namespace pnpbs
