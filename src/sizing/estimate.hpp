// SPDX-License-Identifier: BSD-3-Clause
// Estimates of the nodes, memory and time of a run, and the memory allowed for it.
#pragma once

#include "estimate/node_estimate.hpp"
#include "sizing/limiting_growth.hpp"

namespace pnpbs {

// Estimates nodes, memory and time of a run. Collective.
template <int Dim>
Estimate estimate_of(const EffectiveSpacing<Dim>& to_place, const Settings& settings);

// Returns the number of nodes with which a run with this spacing is expected to end. Collective.
template <int Dim>
double estimated_nodes(const EffectiveSpacing<Dim>& to_place, SizingField<Dim> spacing,
                       const Settings& settings, Samples samples);

// Returns the memory allowed for the nodes of all ranks. [bytes] Ranks share the memory of their
// machines and have equal parts of the nodes. Returns infinity if the option max_memory is 0.
// Collective.
double bytes_allowed(const Communicator& comm, const Options& options);

}  // namespace pnpbs
