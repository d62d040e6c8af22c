// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a level and its partition: who owns which cells, and the tree refined on
// this rank wherever its own nodes and ghosts can be. Another partition is another tree.
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

template <int Dim>
class LevelTree {
 public:
  // Partitioned by the work that d asks for or, where that balances it, as another level is whose
  // spacing is a multiple of this one's. Collective.
  static std::unique_ptr<LevelTree<Dim>> grow(const Communicator& comm,
                                              const LevelGeometry<Dim>& geometry,
                                              const Settings& settings, const LevelTree<Dim>* like);
  // For these cells and owners. Collective.
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
  // Leaves of which one reaches the other.
  const std::shared_ptr<const LeafLinks<Dim>>& links() const { return links_; }
  const Distribution<Dim>& distribution() const { return distribution_; }
  bool owns(std::int32_t leaf) const { return distribution_.owns(leaf); }
  // Rank that owns what is there.
  int owner_at(const Point<Dim>& x) const { return distributed() ? distribution_.owner_at(x) : 0; }
  // Refined so far around the leaves that this rank owns.
  int hops() const { return hops_; }
  void forget_hops() { hops_ = 0; }  // the next exchange grows another tree
  // Made on first use, and kept.
  const Halo& halo(int hops, const Settings& settings);

 private:
  LevelTree(const Communicator& comm, const LevelGeometry<Dim>& geometry)
      : comm_(comm), geometry_(geometry) {}
  bool distributed() const { return comm_.size() > 1; }

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
  std::shared_ptr<const LeafLinks<Dim>> links_;
  Distribution<Dim> distribution_;
  int hops_ = 0;
};

}  // namespace pnpbs
