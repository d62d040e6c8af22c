// SPDX-License-Identifier: BSD-3-Clause
// Multilevel bubble simulation: the first nodes of a level come from a coarser level, where
// long-range errors settle in cheap steps. Each level has twice the spacing of the next finer one.
// Refinement inserts a node in the middle of every edge of the Delaunay stars, which leaves nearly
// every node with six neighbours.
#pragma once

#include "domain/domain.hpp"
#include "level/level.hpp"
#include "settings/settings.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// Returns the number of coarser levels that pay off. There is none if d is nearly constant, because
// one lattice fills the domain then. Levels with few nodes have no long-range errors to settle, and
// bubbles do not come to rest on levels where d varies strongly from one to the next.
// Collective.
template <int Dim>
int useful_coarser_levels(const Level<Dim>& finest, const Domain<Dim>& domain,
                          const SizingField<Dim>& spacing);

// Returns the spacing of the level that is coarser than the finest by this number of levels.
template <int Dim>
SizingField<Dim> spacing_of_level(const SizingField<Dim>& spacing, int level);

// Returns the settings of a coarser level. It runs like a placement of its own, with a smaller
// tolerance, because its errors remain on every finer level. The coarsest level runs for more
// steps.
Settings settings_of_level(Settings settings, bool coarsest);

}  // namespace pnpbs
