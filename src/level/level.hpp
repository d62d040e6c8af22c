// SPDX-License-Identifier: BSD-3-Clause
// One level of the simulation: its geometry, its tree and partition, its nodes, and everything
// derived from them. The functions of this folder are the steps of the method on a level; the
// folder run decides when they are called. Derived data carry a stamp of what they were derived
// from, and the function that needs them derives them again if it has changed.
#pragma once

#include <cstdint>
#include <memory>

#include "base/nodes.hpp"
#include "base/timers.hpp"
#include "comm/communicator.hpp"
#include "delaunay/stars.hpp"
#include "delaunay/volume/element_labels.hpp"
#include "domain/domain.hpp"
#include "level/ghosts.hpp"
#include "level/inexact_nodes.hpp"
#include "level/level_geometry.hpp"
#include "level/level_stamp.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "level/plane/patch_margin.hpp"
#include "level/time_integration.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// The state of a level. Together with the geometry it determines the results; everything else is
// derived from it. Work that may fail copies it first and restores the copy on failure.
template <int Dim>
struct LevelState {
  std::shared_ptr<LevelTree<Dim>> tree;
  Nodes<Dim> nodes;
  Ghosts<Dim> ghosts;
  Settings settings;
  std::int64_t next_id = 0;                // smallest id that was never used
  PatchMargin margin = PatchMargin::laid;  // of the patch of a whole sphere
  std::int64_t rebalances = 0;
  std::int64_t left_out = 0;  // feature nodes that were removed, over all ranks (loose_pieces.hpp)
  std::int64_t held_rounds = 0;   // number of rounds before this level that reduced d
  std::int64_t unknown_uses = 0;  // uses of data that this rank does not know exactly
  InexactNodes inexact;           // since the last exchange, in builds that check it
};

// A copy of the state of a level and of the figures of its derived data. It takes about 100 bytes
// per node and ghost in space, and 80 in the plane.
template <int Dim>
struct LevelCopy {
  LevelState<Dim> state;
  typename Neighbourhood<Dim>::Figures figures;
};

// A level: its state, the geometry, and the derived data.
template <int Dim>
struct Level : LevelState<Dim> {
  using LevelState<Dim>::tree;
  using LevelState<Dim>::nodes;
  using LevelState<Dim>::ghosts;
  using LevelState<Dim>::settings;

  // Discretizes the boundary. The level has no tree and no nodes yet.
  Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const Domain<Dim>> domain,
        std::shared_ptr<const Spacing<Dim>> spacing, const Settings& settings, Timers& timers);

  // Grows the tree and partitions it, like another level if that is given and balances the work.
  // All ranks must call it, and if one rank throws, all ranks throw.
  void grow_tree(const Level<Dim>* like = nullptr);
  // Replaces the tree by one for another partition. Nodes do not migrate yet. If it fails, the
  // level is unchanged. All ranks must call it, and if one rank throws, all ranks throw.
  void adopt_partition(Distribution<Dim> next);
  // Returns a copy of the state that shares no mutable data with it. Local.
  LevelCopy<Dim> copy() const;
  // Restores a copy of this level, and releases the derived data. Local.
  void restore(LevelCopy<Dim>&& earlier) noexcept;
  // Releases everything derived from the nodes, which is derived again on request. All ranks must
  // do so together, to agree on what exists. Local.
  void forget_derived() noexcept;
  // Changes the settings for later steps. The growth limit is part of the spacing and has no effect
  // here.
  void change_settings(const Settings& next);

  // Returns whether the level has ghosts: nodes of other ranks or images in a periodic domain.
  bool distributed() const { return comm->size() > 1 || geometry.cell().any(); }
  const SizedTree<Dim>& map() const { return tree->map(); }
  const AdjacencyList<Dim>& lists() const { return neighbourhood.lists(); }
  // Returns a stamp that changes with the nodes, the lists and the settings.
  std::int64_t version() const {
    return nodes.version() + neighbourhood.rebuilds() + settings_version;
  }
  LevelStamp stamp() const { return {number, version()}; }
  std::int64_t owned_count() const;

  // Releases the stars and what is derived from them.
  void forget_stars() noexcept;

  const std::int64_t number;  // unique among the levels of this process
  std::shared_ptr<const Communicator> comm;
  Timers& timers;

  LevelGeometry<Dim> geometry;
  Neighbourhood<Dim> neighbourhood;
  Stars<Dim> stars;
  KeptStarsBefore<Dim> stars_before;
  // In space: digest of the nodes that the stars belong to; 0: none.
  std::uint64_t stars_digest = 0;
  ChangedLabels changed_labels;  // of elements in space, after settle_elements()
  // version() for which make_finish_stars() has found the stars of the owned nodes, or -1.
  std::int64_t finish_stars = -1;
  TimeIntegration<Dim> time_integration;

  // Counts changes that invalidate derived data but not the nodes.
  std::int64_t settings_version = 0;
};

// Returns the number of boundary nodes on all ranks. Collective in space.
std::int64_t boundary_nodes(const Level<2>& level);
std::int64_t boundary_nodes(const Level<3>& level);

}  // namespace pnpbs
