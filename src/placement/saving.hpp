// SPDX-License-Identifier: BSD-3-Clause
// Placements as they are saved, and as they go on from there.
#pragma once

#include <cstdint>
#include <vector>

#include "level/level.hpp"
#include "placement/placed_spacing.hpp"
#include "placement/run_state.hpp"
#include "placement/saved_state.hpp"
#include "settings/options.hpp"
#include "spacing/nodal_patch.hpp"

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

// The nodes of a level, and where its run is. `given`: the user's spacing; at_event: is the step
// one whose event has not been asked yet if the bubbles rest? Collective.
template <int Dim>
Saved<Dim> saved_of(const Level<Dim>& level, const Held<Dim>& held, const Spacing<Dim>& given,
                    const RunState& run, const Options& options, bool at_event);

// Throws Error(ErrorKind::state) if the nodes wait for another spacing than they were placed for:
// one that replaced it, or what these options have made of it since then.
void require_savable_spacing(bool replaced, const Options& now, const Options& then);
// Throws what no placement can have saved.
void require_possible(const SavedState& saved);
template <int Dim>
Held<Dim> held_in(const SavedState& saved);
// On a level that has none, if its boundary and its spacing are those of then. Collective.
template <int Dim>
void put_saved_nodes(Level<Dim>& level, const SavedState& saved,
                     std::vector<SavedNode<Dim>>& nodes);
// The run goes on from there, on that level.
template <int Dim>
void adopt_state(const SavedState& saved, RunState& run, Level<Dim>& level);

}  // namespace pnpbs
