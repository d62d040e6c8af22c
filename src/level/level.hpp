// SPDX-License-Identifier: BSD-3-Clause
// One level of the simulation: what it stands on, its tree and partition, its nodes, and all that
// is found from them. What is done with a level, the steps of the method, are the functions of this
// folder; when they are done is the placement's business. Each of its parts knows what it was found
// from, and is found again by the function that needs it.
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

// What a level's results follow from, besides the ground that it stands on. All else is derived
// from this. A copy is taken before work that may fail, and put back if it does.
template <int Dim>
struct LevelState {
  std::shared_ptr<LevelTree<Dim>> tree;
  Nodes<Dim> nodes;
  Ghosts<Dim> ghosts;
  Settings settings;
  std::int64_t next_id = 0;                // no node has had it or a larger one
  PatchMargin margin = PatchMargin::laid;  // of a whole sphere
  std::int64_t rebalances = 0;
  std::int64_t left_out = 0;      // of the nodes on features, over all ranks (loose_pieces.hpp)
  std::int64_t held_rounds = 0;   // in which d was held down before this level
  std::int64_t unknown_uses = 0;  // of data that this rank does not know exactly
  InexactNodes inexact;           // since the last exchange, in builds that look
};

// A copy of a level's state, and the figures that statistics tell of what is derived from it. It
// takes about 100 bytes for each node and ghost in space, 80 in the plane.
template <int Dim>
struct LevelCopy {
  LevelState<Dim> state;
  typename Neighbourhood<Dim>::Figures figures;
};

template <int Dim>
struct Level : LevelState<Dim> {
  using LevelState<Dim>::tree;
  using LevelState<Dim>::nodes;
  using LevelState<Dim>::ghosts;
  using LevelState<Dim>::settings;

  // Discretizes the boundary. The tree is yet to be grown, the nodes are yet to come.
  Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const Domain<Dim>> domain,
        std::shared_ptr<const Spacing<Dim>> spacing, const Settings& settings, Timers& timers);

  // And partitions it: as another level, if that is given and balances the work. Collective.
  void grow_tree(const Level<Dim>* like = nullptr);
  // Another partition; the nodes are yet to migrate. If it fails, all stays as it was. Collective.
  void adopt_partition(Distribution<Dim> next);
  // A copy of what counts, which shares nothing that changes. Local.
  LevelCopy<Dim> copy() const;
  // Puts back a copy that was taken of this level. What was derived is forgotten. Local.
  void restore(LevelCopy<Dim>&& earlier) noexcept;
  // Forgets what is derived from the nodes: it is found again when it is asked for. All ranks do
  // this together, so that they agree on what is there. Local.
  void forget_derived() noexcept;
  // For the steps to come; the growth limit belongs to the spacing and is not among them.
  void change_settings(const Settings& next);

  bool distributed() const { return comm->size() > 1; }
  const SizedTree<Dim>& map() const { return tree->map(); }
  const AdjacencyList<Dim>& lists() const { return neighbourhood.lists(); }
  // Changes with the nodes and with the lists.
  std::int64_t version() const {
    return nodes.version() + neighbourhood.rebuilds() + settings_version;
  }
  LevelStamp stamp() const { return {number, version()}; }
  std::int64_t owned_count() const;

  // Forgets the stars and what was derived from them.
  void forget_stars() noexcept;

  const std::int64_t number;  // of the levels that this process has made
  std::shared_ptr<const Communicator> comm;
  Timers& timers;

  LevelGeometry<Dim> geometry;
  Neighbourhood<Dim> neighbourhood;
  Stars<Dim> stars;
  KeptStarsBefore<Dim> stars_before;
  std::uint64_t stars_digest = 0;  // in space: of the nodes for which the stars are right; 0: none
  ChangedLabels changed_labels;    // of elements in space, once they are settled
  std::int64_t finish_stars =
      -1;  // version in which the stars are those that finishing begins with
  TimeIntegration<Dim> time_integration;

  std::int64_t settings_version = 0;  // counts what makes derived data stale, but the nodes do not
};

// Of all ranks. Collective in space.
std::int64_t boundary_nodes(const Level<2>& level);
std::int64_t boundary_nodes(const Level<3>& level);

}  // namespace pnpbs
