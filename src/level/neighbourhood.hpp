// SPDX-License-Identifier: BSD-3-Clause
// What is near the nodes of a level: buckets, the boundary edges near nodes, adjacency lists. All
// of it is derived from the nodes and the tree, and stamped with what it was derived from.
#pragma once

#include <cstdint>

#include "level/ground.hpp"
#include "level/level_tree.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/boundary_visibility.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

class Neighbourhood {
 public:
  // A new boundary of so many nodes.
  void reset_boundary(std::size_t nodes) { boundary_visibility_.reset(nodes); }
  // For another tree, or another radius of the edges near nodes: what was found by this.
  static NearEdges edges_near_leaves(const LevelTree& tree, double radius);
  void adopt(const LevelTree& tree, NearEdges edges_near_leaves);

  // Sorts the nodes in memory by bucket; returns whether they changed their places. First of all
  // before lists are made.
  bool sort_nodes(Nodes<2>& nodes, const LevelTree& tree, const Settings& settings);
  // Lists for the time loop: visibility is judged from the reference positions, so that it does not
  // matter when they are made.
  void rebuild_for_steps(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree,
                         const Settings& settings);
  // Lists of that radius for where the nodes are. The next step makes its own again; until then
  // there are stars, and no need to know where nodes were: the two take their memory in turn.
  void rebuild_here(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree, double radius);
  // Might the lists for steps lack a pair within the range of the force?
  bool needs_rebuild(const Nodes<2>& nodes, const Settings& settings) const;

  // Were the lists made with that radius for where the nodes are?
  bool made_here(const Nodes<2>& nodes, double radius) const {
    return !for_steps_ && arrangement_ == nodes.arrangement() && positions_ == nodes.positions() &&
           references_ == nodes.references() && lists_.radius() == radius;
  }

  // The largest displacement since the lists for steps were made, in units of d, of the nodes from
  // `first` up to `last` if they were at x; squared.
  double squared_displacement(const Nodes<2>& nodes, const Field<2>& x, std::int64_t first,
                              std::int64_t last) const;
  // The largest one so far, of all nodes.
  void set_max_displacement(double displacement) { max_displacement_ = displacement; }
  // Finds it, as the update of ghosts moves them, too.
  void measure_displacement(const Nodes<2>& nodes);

  // Nodes come and go: those named stay, in this order.
  void keep_nodes(Nodes<2>& nodes, const View<std::int32_t>& places, std::int64_t kept);
  // New nodes instead of all: the bucket of each is to be written.
  const View<std::int32_t>& buckets_of_new(const Nodes<2>& nodes) {
    return buckets_.buckets_of_new(nodes);
  }

  const Buckets<2>& buckets() const { return buckets_; }
  const NearEdges& near_edges() const { return near_edges_; }
  const AdjacencyList<2>& lists() const { return lists_; }
  std::int64_t rebuilds() const { return rebuilds_; }

  // Of owned nodes: listed pairs, and as much again for each node as it costs besides. Counted when
  // lists are made for the first time after an event, or after this.
  std::int64_t owned_work() const { return owned_work_; }
  void recount_work() { work_counted_ = -1; }
  // The same of one node.
  std::int64_t work_of(std::int64_t i) const;

 private:
  void rebuild(Nodes<2>& nodes, const Ground& ground, const LevelTree& tree, double radius,
               const Field<2>& seen_from);
  void count_work(const Nodes<2>& nodes);

  const LevelTree* prepared_for_ = nullptr;
  Buckets<2> buckets_;
  NearEdges near_edges_;
  BoundaryVisibility boundary_visibility_;
  AdjacencyList<2> lists_;
  std::int64_t rebuilds_ = 0;

  // What the lists were made of: stamps of the nodes; -1: they must be made anew.
  std::int64_t arrangement_ = -1, positions_ = -1, references_ = -1;
  bool for_steps_ = false;
  Field<2> listed_;  // if they are for steps: positions at which they were made
  double max_displacement_ = 0;

  std::int64_t owned_work_ = 0, work_counted_ = -1;  // for these reference positions
};

}  // namespace pnpbs
