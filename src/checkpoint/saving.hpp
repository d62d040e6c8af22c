// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a placement to the contents of a checkpoint, and restart from them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "checkpoint/saved_state.hpp"
#include "level/level.hpp"
#include "run/level_builder.hpp"
#include "run/run_state.hpp"
#include "settings/options.hpp"
#include "sizing/limiting_growth.hpp"
#include "sizing/placed_spacing.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// The contents of a checkpoint that is to be written. Node data are those of this rank.
template <int Dim>
struct Saved {
  SavedState state;
  // Must outlive this object.
  const Nodes<Dim>* nodes = nullptr;
  std::vector<std::int32_t> owned;    // indices of the owned nodes
  View<double> spacing;               // d by node, as in SavedNode::spacing
  const Patch<Dim>* patch = nullptr;  // values at earlier nodes if d is given by them, or null

  std::int64_t count() const { return static_cast<std::int64_t>(owned.size()); }
  SavedNode<Dim> node(std::int64_t k) const {
    const std::int32_t i = owned[static_cast<std::size_t>(k)];
    return {packed(*nodes, i), spacing(i)};
  }
};

// Returns the contents of a checkpoint of this level and run. `spacing` is the user's spacing with
// the undersampled points that runs have found. `at_event` is true if the event of the present step
// has not yet tested whether the bubbles rest. Collective.
template <int Dim>
Saved<Dim> saved_of(const Level<Dim>& level, const PlacedSpacing<Dim>& placed,
                    const SizingField<Dim>& spacing, const RunState& run, const Options& options,
                    bool at_event);

// Returns the undersampled points that earlier runs have found. Throws Error(ErrorKind::file) if
// they are invalid.
template <int Dim>
SpacingHints<Dim> undersampled_points_of(const SavedState& saved);

// Throws Error(ErrorKind::state) if the spacing has been replaced or changed by options since the
// nodes were placed. The nodes do not fit the spacing then.
void require_savable_spacing(bool replaced, const Options& now, const Options& then);
// Throws unless the checkpoint is of this dimension, this domain and these options, and valid.
// Collective.
template <int Dim>
void require_same_as(const SavedState& saved, const Communicator& comm, Domain<Dim>& domain,
                     const Options& options);
// Returns a level with the saved nodes. Throws if its boundary or spacing differs from those of the
// checkpoint. `nodes` may be in any distribution over the ranks; together they must be complete.
// Collective.
template <int Dim>
std::shared_ptr<Level<Dim>> saved_level(const SavedState& saved, std::vector<SavedNode<Dim>> nodes,
                                        LevelBuilder<Dim>& builder,
                                        const EffectiveSpacing<Dim>& to_place,
                                        const Settings& settings, PlacedSpacing<Dim>& placed);
// Sets the state of the run and of the level to that of the checkpoint.
template <int Dim>
void adopt_state(const SavedState& saved, RunState& run, Level<Dim>& level);

}  // namespace pnpbs
