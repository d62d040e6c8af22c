// SPDX-License-Identifier: BSD-3-Clause
// What a run would come to, and how much memory there is for it.
#pragma once

#include "estimate/node_estimate.hpp"
#include "sizing/limiting_growth.hpp"

namespace pnpbs {

// Collective.
template <int Dim>
Estimate estimate_of(const EffectiveSpacing<Dim>& to_place, const Settings& settings);

// The nodes with which a run with this spacing is expected to end. Collective.
template <int Dim>
double estimated_nodes(const EffectiveSpacing<Dim>& to_place, SizingField<Dim> spacing,
                       const Settings& settings, Samples samples);

// Of memory, for the nodes of all ranks: these share what their machines have, and hold equal
// parts. Collective.
double bytes_allowed(const Communicator& comm, const Options& options);

}  // namespace pnpbs
