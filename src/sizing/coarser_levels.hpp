// SPDX-License-Identifier: BSD-3-Clause
// Multilevel bubble simulation: the first nodes of a level come from a coarser one, where what is
// wrong over long distances settles in cheap steps. Each level has twice the spacing of the next;
// to refine it, a node comes into the middle of every edge of its Delaunay stars, which leaves
// nearly every node with its six neighbours.
#pragma once

#include "domain/domain.hpp"
#include "level/level.hpp"
#include "settings/settings.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// None where d is nearly the same everywhere: then one lattice fills the domain. A level of few
// nodes has nothing to settle over long distances, and bubbles of a spacing that varies from one to
// the next have no rest. Collective, as the spacing is asked.
template <int Dim>
int coarser_levels_that_pay(const Level<Dim>& finest, const Domain<Dim>& domain,
                            const SizingField<Dim>& spacing);

// Of the level that is coarser than the finest by so many; of that itself if it is none.
template <int Dim>
SizingField<Dim> spacing_of_level(const SizingField<Dim>& spacing, int level);

// A coarser level runs like a placement of its own; the coarsest has the most to settle. What
// is wrong there is wrong on every finer one, too.
Settings settings_of_level(Settings settings, bool coarsest);

}  // namespace pnpbs
