// SPDX-License-Identifier: BSD-3-Clause
// The values of d at the nodes of a level.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

// Returns a spacing at the nodes and ghosts of this rank. All ranks must call it, and if one rank
// throws, all ranks throw.
template <int Dim>
View<double> spacing_at_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing);
// Returns the same with undefined values at ghosts.
template <int Dim>
View<double> spacing_at_owned_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing);

// Sets d of the owned nodes to the spacing at their positions, and makes the present positions the
// reference for visibility. Ghosts get their d in the next exchange. All ranks must call it, and if
// one rank throws, all ranks throw.
template <int Dim>
void refresh_spacing(Level<Dim>& level);

}  // namespace pnpbs
