// SPDX-License-Identifier: BSD-3-Clause
// What a call of a placement may change, as a value. A call that moves nodes takes a copy when it
// begins, and the copy is put back on all ranks where it fails.
#pragma once

#include <memory>
#include <optional>

#include "domain/domain.hpp"
#include "level/level.hpp"
#include "run/run_state.hpp"
#include "settings/options.hpp"
#include "sizing/holding_spacing.hpp"
#include "sizing/placed_spacing.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

template <int Dim>
struct PlacementState {
  SizingField<Dim> spacing;       // the user's, with the places that runs have found to be finer
  bool spacing_replaced = false;  // since the level was made
  std::shared_ptr<Level<Dim>> level;          // has the nodes; null before there are any
  std::shared_ptr<const Domain<Dim>> closed;  // the domain; a whole sphere closed for the spacing
  PlacedSpacing<Dim> placed;                  // with which the level was made
  Options level_options;                      // with which it was
  Unresolved<Dim> unresolved;                 // by the last finish
};

// What a placement was when a call began. The level is the same object, which the call may change:
// so a copy of its nodes is kept beside it.
template <int Dim>
struct PlacementBefore {
  PlacementState<Dim> state;
  RunState run;
  std::optional<LevelCopy<Dim>> level;  // none if there was none, or if it has been put back

  // Gives the level its nodes back and frees the copy. What was derived from the nodes is freed,
  // too, so that a level that another one has replaced takes little memory.
  void restore_level() noexcept {
    if (level) state.level->restore(std::move(*level));
    level.reset();
  }
};

}  // namespace pnpbs
