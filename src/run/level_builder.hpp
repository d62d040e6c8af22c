// SPDX-License-Identifier: BSD-3-Clause
// Makes levels: boundary, tree, growth limit, and the nodes that they begin with. What is made is
// handed to the caller, who makes it the level there is.
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

// The nodes that a level may begin with: those of the level before or, if there is none, those
// given, each null if there are none; else it is filled.
template <int Dim>
struct StartNodes {
  Level<Dim>* level = nullptr;
  const IncomingNodes<Dim>* given = nullptr;
};

template <int Dim>
struct BuiltLevel {
  std::shared_ptr<Level<Dim>> level;
  PlacedSpacing<Dim> placed;
  FirstNodes first_nodes = FirstNodes::laid;
  ImportedNodes taken;
  std::int64_t inserted = 0;             // nodes that came with it, on all ranks
  Outcome outcome = Outcome::converged;  // or stopped by the monitor
};

// All functions are collective.
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

  // A level without nodes for the user's spacing, whose growth is limited where the user wants it
  // so or, by how steep it is, where nodes could not follow it. `placed` tells where it is held
  // down, and is told what the spacing is.
  std::shared_ptr<Level<Dim>> level_to_place(const EffectiveSpacing<Dim>& to_place,
                                             const Settings& settings, PlacedSpacing<Dim>& placed);
  // A level without inner nodes yet, partitioned like another one if that is given.
  std::shared_ptr<Level<Dim>> empty_level(const SizingField<Dim>& spacing, const Settings& settings,
                                          const Level<Dim>* like = nullptr);
  // Puts nodes on a level that has none: those before, refined where they are of a coarser level,
  // those that coarser levels lead to, or a fill.
  BuiltLevel<Dim> with_first_nodes(std::shared_ptr<Level<Dim>> level, PlacedSpacing<Dim> placed,
                                   const Settings& settings, const StartNodes<Dim>& before);

 private:
  void limit_growth(const EffectiveSpacing<Dim>& to_place, SizingField<Dim>& spacing,
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
  int filled_levels_ = 0;  // of the coarser ones, those with their inside filled
};

extern template class LevelBuilder<2>;
extern template class LevelBuilder<3>;

}  // namespace pnpbs
