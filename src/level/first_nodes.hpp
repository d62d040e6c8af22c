// SPDX-License-Identifier: BSD-3-Clause
// The first inner nodes of a level without nodes (section 2.1).
#pragma once

#include <functional>

#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Returns the inner nodes of this rank, without ids. Calls beat() regularly. `stretched` allows
// lattices that are stretched to fit. All ranks must call it, and if one rank throws, all ranks
// throw.
template <int Dim>
IncomingNodes<Dim> first_inner_nodes(
    const Level<Dim>& level, const std::function<void()>& beat = [] {}, bool stretched = true);

// Fills a level: its nodes become the boundary nodes `laid` and first_inner_nodes(). Calls beat()
// regularly. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void fill(
    Level<Dim>& level, BoundaryNodes<Dim> laid, const std::function<void()>& beat = [] {},
    bool stretched = true);

}  // namespace pnpbs
