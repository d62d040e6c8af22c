// SPDX-License-Identifier: BSD-3-Clause
// The construction of levels: boundary, tree, growth limit and first nodes. The caller installs the
// level that is built.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "initial/incoming_nodes.hpp"
#include "level/boundary_nodes.hpp"
#include "level/imported_nodes.hpp"
#include "level/level.hpp"
#include "run/level_context.hpp"
#include "run/outcome.hpp"
#include "run/schedule.hpp"
#include "settings/options.hpp"
#include "sizing/limiting_growth.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// The nodes that a new level may start with: those of the level before or, without one, those that
// the user gives. If both pointers are null, the level is filled.
template <int Dim>
struct StartNodes {
  Level<Dim>* level = nullptr;
  const IncomingNodes<Dim>* given = nullptr;
};

// A new level with its first nodes and the counts of its construction.
template <int Dim>
struct BuiltLevel {
  std::shared_ptr<Level<Dim>> level;
  PlacedSpacing<Dim> placed;
  FirstNodes first_nodes = FirstNodes::laid;
  ImportedNodes taken;
  std::int64_t inserted = 0;             // nodes inserted during the construction, on all ranks
  Outcome outcome = Outcome::converged;  // `converged`, or `stopped` by the monitor
};

// Builds levels. All ranks must call its functions, and if one rank throws, all ranks throw.
template <int Dim>
class LevelBuilder {
 public:
  LevelBuilder(std::shared_ptr<const Communicator> comm, std::shared_ptr<const Domain<Dim>> domain,
               const Options& options, Timers& timers, LevelContext<Dim> context)
      : comm_(std::move(comm)),
        domain_(std::move(domain)),
        options_(options),
        timers_(timers),
        context_(context) {}

  // Returns a level without nodes for the user's spacing. The growth of the spacing is limited if
  // the user requests it, or if it is too steep for nodes to follow. On entry `placed` says where d
  // is reduced; on return it has the spacing of the level.
  std::shared_ptr<Level<Dim>> level_to_place(const EffectiveSpacing<Dim>& placement_spacing,
                                             const Settings& settings, PlacedSpacing<Dim>& placed);
  // Returns a level without inner nodes. It is partitioned like `like` if that is not null.
  std::shared_ptr<Level<Dim>> empty_level(const SizingField<Dim>& spacing, const Settings& settings,
                                          const Level<Dim>* like = nullptr);
  // Puts the first nodes on an empty level: those of `before`, refined where d has become finer,
  // those from coarser levels, or a fill.
  BuiltLevel<Dim> with_first_nodes(std::shared_ptr<Level<Dim>> level, PlacedSpacing<Dim> placed,
                                   const Settings& settings, const StartNodes<Dim>& before);

 private:
  void limit_growth(const EffectiveSpacing<Dim>& placement_spacing, SizingField<Dim>& spacing,
                    const Settings& settings);
  void take_kept_nodes(BuiltLevel<Dim>& made, Level<Dim>& before);
  void take_given_nodes(BuiltLevel<Dim>& made, IncomingNodes<Dim> given);
  void begin_anew(BuiltLevel<Dim>& made, const Settings& settings);
  void begin_on_surfaces(BuiltLevel<Dim>& made, const Settings& settings,
                         const StartNodes<Dim>& before);  // in space
  IncomingNodes<Dim> nodes_from_coarser_levels(const BuiltLevel<Dim>& finest,
                                               const Settings& settings, Outcome& outcome);
  void put_first_nodes(Level<Dim>& level, IncomingNodes<Dim>& from_coarser, int which,
                       Outcome& outcome);
  void fill(Level<Dim>& level, BoundaryNodes<Dim> laid);
  std::int64_t over_ranks(std::int64_t mine) const;

  std::shared_ptr<const Communicator> comm_;
  std::shared_ptr<const Domain<Dim>> domain_;
  const Options& options_;
  Timers& timers_;
  LevelContext<Dim> context_;
  int filled_levels_ = 0;  // number of coarser levels whose inside is filled as well
};

extern template class LevelBuilder<2>;
extern template class LevelBuilder<3>;

}  // namespace pnpbs
