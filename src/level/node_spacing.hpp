// SPDX-License-Identifier: BSD-3-Clause
// d at the nodes of a level.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

// Of any spacing, at the places of the nodes and their ghosts. Collective.
template <int Dim>
View<double> spacing_at_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing);
// The same, but what is at the places of ghosts means nothing.
template <int Dim>
View<double> spacing_at_owned_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing);

// An event: d at the owned nodes becomes what the spacing is there, and visibility is judged from
// where nodes are now. Ghosts get theirs with the next exchange. Collective.
template <int Dim>
void refresh_spacing(Level<Dim>& level);

}  // namespace pnpbs
