// SPDX-License-Identifier: BSD-3-Clause
// The state of a placement that a call may change, as a value. A call that changes nodes copies it
// at its beginning. If the call fails, all ranks restore the copy.
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
  // The user's spacing, with the undersampled points that runs have found.
  SizingField<Dim> spacing;
  bool spacing_replaced = false;      // true if the spacing was set after the level was built
  std::shared_ptr<Level<Dim>> level;  // owns the nodes; null before there are any
  // The domain. A whole sphere has its closing patch added.
  std::shared_ptr<const Domain<Dim>> closed;
  PlacedSpacing<Dim> placed;   // the spacing that the level was built for
  Options level_options;       // the options that the level was built with
  Unresolved<Dim> unresolved;  // found by the last finish
};

// The state of a placement at the beginning of a call. The call changes the level in place, so a
// copy of the nodes is stored in addition to the pointer.
template <int Dim>
struct PlacementBefore {
  PlacementState<Dim> state;
  RunState run;
  std::optional<LevelCopy<Dim>> level;  // empty if there was no level, or once it is restored

  // Restores the nodes of the level and releases the copy. Derived data are released as well, so
  // that a replaced level takes little memory.
  void restore_level() noexcept {
    if (level) state.level->restore(std::move(*level));
    level.reset();
  }
};

}  // namespace pnpbs
