// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a level and its partition: which rank owns which cells, and the tree
// refined on this rank wherever its nodes and ghosts can be. A new partition requires a new tree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "level/level_geometry.hpp"
#include "partition/distribution.hpp"
#include "settings/settings.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

// The tree of a level. All ranks have the same cells of the partition, but different leaves.
template <int Dim>
class LevelTree {
 public:
  // Grows a tree and partitions it by the work that d implies. If `like` is given and balances that
  // work, its partition is used; its spacing must be a multiple of this one. All ranks must call
  // it, and if one rank throws, all ranks throw.
  static std::unique_ptr<LevelTree<Dim>> grow(const Communicator& comm,
                                              const LevelGeometry<Dim>& geometry,
                                              const Settings& settings, const LevelTree<Dim>* like);
  // Grows a tree for these cells and owners. All ranks must call it, and if one rank throws, all
  // ranks throw.
  static std::unique_ptr<LevelTree<Dim>> grow(const Communicator& comm,
                                              const LevelGeometry<Dim>& geometry,
                                              const Settings& settings,
                                              Distribution<Dim> distribution);
  LevelTree(const LevelTree<Dim>&) = delete;  // the distribution points to the tree
  LevelTree<Dim>& operator=(const LevelTree<Dim>&) = delete;

  const Communicator& comm() const { return comm_; }
  const LevelGeometry<Dim>& geometry() const { return geometry_; }
  const SizedTree<Dim>& map() const { return map_; }
  const BackgroundTree<Dim>& tree() const { return map_.tree(); }
  // Returns the pairs of leaves that interact.
  const std::shared_ptr<const LeafGraph<Dim>>& links() const { return links_; }
  const Distribution<Dim>& distribution() const { return distribution_; }
  bool owns(std::int32_t leaf) const { return distribution_.owns(leaf); }
  // Returns the rank that owns this point.
  int owner_at(const Point<Dim>& x) const {
    return distributed() ? distribution_.images().rank(distribution_.owner_at(x)) : 0;
  }
  // Returns whether nodes have copies on other ranks, or images on this one.
  bool distributed() const { return comm_.size() > 1 || geometry_.cell().any(); }
  // Returns the depth in hops around this rank's leaves to which the tree is refined.
  int hops() const { return hops_; }
  void forget_hops() { hops_ = 0; }  // requires the next exchange to grow another tree
  // Returns the halo of this depth, which is computed on first use and stored.
  const Halo& halo(int hops, const Settings& settings);

 private:
  LevelTree(const Communicator& comm, const LevelGeometry<Dim>& geometry)
      : comm_(comm), geometry_(geometry) {}

  void grow_whole(const Settings& settings);
  void grow_part(const Settings& settings, const LevelTree<Dim>* like);
  void take_rough_cells(const Settings& settings);
  std::vector<PartitionCell<Dim>> rough_cells(const Settings& settings);
  void refine(const Settings& settings, const std::vector<char>& refined);
  std::vector<GrowthSource<Dim>> spacing_hints() const;
  void link_leaves(const Settings& settings);
  void grow_own_part(const Settings& settings);
  void require_same_geometry() const;
  void require_same_leaves() const;

  const Communicator& comm_;
  const LevelGeometry<Dim>& geometry_;
  SizedTree<Dim> map_;
  std::shared_ptr<const LeafGraph<Dim>> links_;
  Distribution<Dim> distribution_;
  int hops_ = 0;
};

}  // namespace pnpbs
