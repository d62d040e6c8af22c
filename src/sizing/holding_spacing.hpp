// SPDX-License-Identifier: BSD-3-Clause
// Where the elements of a finished run do not fill the domain, their boundary is torn, or their
// angles are small, d does not resolve the shape: it is held down around these places, and the run
// goes on from its nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "check/conformity.hpp"
#include "level/level.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// The spacing that counts, from the one that would and the places where it is held down.
// Collective.
template <int Dim>
void hold_down(const Communicator& comm, PlacedSpacing<Dim>& placed, const Settings& settings);

// Of this rank's nodes and ghosts, those where d is held down; an empty view if there are no such
// places. Collective.
template <int Dim>
View<char> held_nodes(const Level<Dim>& level, const PlacedSpacing<Dim>& placed);

// Where d is to be held down next.
template <int Dim>
struct Unresolved {
  std::vector<Point<Dim>> places;  // of this rank
  std::int64_t small_angles = 0;   // elements with one, over all ranks, if they conform
  ElementFaults faults;            // over all ranks
};

// Adds the places at which the last round asks for a smaller d, which left these places of this
// rank unresolved; false if there are none, or that was tried often enough. Collective.
template <int Dim>
bool add_unresolved_places(const Level<Dim>& level, const Unresolved<Dim>& unresolved,
                           LocalReduction<Dim>& held);

// Would a round with so many nodes take far more than the spacing asks for? More may come if the
// last one does not conform.
template <int Dim>
bool takes_too_many(double expected_nodes, const LocalReduction<Dim>& held, bool conforms);

// That a round with so many nodes was not begun, where elements do not conform.
template <int Dim>
Warning warning_of_too_many(double expected_nodes, const LocalReduction<Dim>& held);

// That d is held down, of a run with so many nodes.
template <int Dim>
Warning warning_of_held_spacing(const LocalReduction<Dim>& held, std::int64_t nodes);

}  // namespace pnpbs
