// SPDX-License-Identifier: BSD-3-Clause
// Placements as they are saved, and as they go on from there.
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

// A placement as it is saved: of its nodes, those of this rank.
template <int Dim>
struct Saved {
  SavedState state;
  const Nodes<Dim>* nodes = nullptr;
  std::vector<std::int32_t> owned;    // indices into these
  View<double> spacing;               // by the same
  const Patch<Dim>* patch = nullptr;  // of a spacing by values at nodes there were; else none

  std::int64_t count() const { return static_cast<std::int64_t>(owned.size()); }
  SavedNode<Dim> node(std::int64_t k) const {
    const std::int32_t i = owned[static_cast<std::size_t>(k)];
    return {packed(*nodes, i), spacing(i)};
  }
};

// The nodes of a level, and where its run is. `spacing`: the user's, with the places that runs
// found to be finer; at_event: is the step one whose event has not been asked yet if the bubbles
// rest? Collective.
template <int Dim>
Saved<Dim> saved_of(const Level<Dim>& level, const PlacedSpacing<Dim>& placed,
                    const SizingField<Dim>& spacing, const RunState& run, const Options& options,
                    bool at_event);

// The places that runs had found to be finer.
template <int Dim>
SpacingHints<Dim> undersampled_points_of(const SavedState& saved);

// Throws Error(ErrorKind::state) if the nodes wait for another spacing than they were placed for:
// one that replaced it, or what these options have made of it since then.
void require_savable_spacing(bool replaced, const Options& now, const Options& then);
// Throws unless it is of this dimension, domain and these options. Collective.
template <int Dim>
void require_same_as(const SavedState& saved, const Communicator& comm, Domain<Dim>& domain,
                     const Options& options);
// The level that goes on from there, if its boundary and its spacing are those of then. `nodes`:
// anyone's, all of them over all ranks. Collective.
template <int Dim>
std::shared_ptr<Level<Dim>> saved_level(const SavedState& saved, std::vector<SavedNode<Dim>> nodes,
                                        LevelBuilder<Dim>& builder,
                                        const EffectiveSpacing<Dim>& to_place,
                                        const Settings& settings, PlacedSpacing<Dim>& placed);
// The run goes on from there, on that level.
template <int Dim>
void adopt_state(const SavedState& saved, RunState& run, Level<Dim>& level);

}  // namespace pnpbs
