// SPDX-License-Identifier: BSD-3-Clause
// First inner nodes where there were none (section 2.1).
#pragma once

#include <functional>

#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Those of this rank, yet to be numbered. Calls beat() again and again. Collective.
template <int Dim>
IncomingNodes<Dim> first_inner_nodes(
    const Level<Dim>& level, const std::function<void()>& beat = [] {}, bool stretched = true);

// They become those of the level, beside those of the boundary. Calls beat() again and again: if it
// throws on one rank, all throw. Collective.
template <int Dim>
void fill(
    Level<Dim>& level, BoundaryNodes<Dim> laid, const std::function<void()>& beat = [] {},
    bool stretched = true);

}  // namespace pnpbs
