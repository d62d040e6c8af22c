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
#include "level/ground.hpp"
#include "level/inexact_nodes.hpp"
#include "level/level_stamp.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "level/plane/patch_margin.hpp"
#include "level/time_integration.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

template <int Dim>
struct Level {
  // Discretizes the boundary. The tree is yet to be grown, the nodes are yet to come.
  Level(std::shared_ptr<const Communicator> comm, std::shared_ptr<const Domain<Dim>> domain,
        std::shared_ptr<const Spacing<Dim>> spacing, const Settings& settings, Timers& timers);

  // And partitions it: as another level, if that is given and balances the work. Collective.
  void grow_tree(const Level<Dim>* like = nullptr);
  // Another partition; the nodes are yet to migrate. If it fails, all stays as it was. Collective.
  void adopt_partition(Distribution<Dim> next);
  // For the steps to come; the growth limit belongs to the spacing and is not among them.
  void change_settings(const Settings& next);

  bool distributed() const { return comm->size() > 1; }
  const DomainMap<Dim>& map() const { return tree->map(); }
  const AdjacencyList<Dim>& lists() const { return neighbourhood.lists(); }
  // Changes with the nodes and with the lists.
  std::int64_t version() const {
    return nodes.version() + neighbourhood.rebuilds() + settings_version;
  }
  LevelStamp stamp() const { return {number, version()}; }
  std::int64_t owned_count() const;

  const std::int64_t number;  // of the levels that this process has made
  std::shared_ptr<const Communicator> comm;
  Settings settings;
  Timers& timers;

  Ground<Dim> ground;
  std::unique_ptr<LevelTree<Dim>> tree;
  Nodes<Dim> nodes;
  std::int64_t next_id = 0;  // no node has had it or a larger one
  Ghosts<Dim> ghosts;
  Neighbourhood<Dim> neighbourhood;
  Stars<Dim> stars;
  KeptStarsBefore<Dim> stars_before;
  std::uint64_t stars_digest = 0;  // in space: of the nodes for which the stars are right; 0: none
  ChangedLabels changed_labels;    // of elements in space, once they are settled
  std::int64_t finish_stars =
      -1;  // version in which the stars are those that finishing begins with
  TimeIntegration<Dim> time_integration;

  std::int64_t settings_version = 0, rebalances = 0;
  PatchMargin margin = PatchMargin::laid;  // of a whole sphere
  std::int64_t left_out = 0;      // of the nodes on features, over all ranks (loose_pieces.hpp)
  std::int64_t held_rounds = 0;   // in which d was held down before this level
  std::int64_t unknown_uses = 0;  // of data that this rank does not know exactly
  InexactNodes inexact;           // since the last exchange, in builds that look
};

// Of all ranks. Collective in space.
std::int64_t boundary_nodes(const Level<2>& level);
std::int64_t boundary_nodes(const Level<3>& level);

}  // namespace pnpbs
