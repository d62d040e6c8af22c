// SPDX-License-Identifier: BSD-3-Clause
// Local reductions of d where it does not resolve the shape: where the elements of a finished run
// do not fill the domain, their boundary is torn, or their angles are small. The run continues from
// its nodes with the reduced d.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "check/conformity.hpp"
#include "level/level.hpp"
#include "sizing/placed_spacing.hpp"

namespace pnpbs {

// Replaces the reductions in placed.d by those of placed.held. Collective.
template <int Dim>
void apply_local_reductions(const Communicator& comm, PlacedSpacing<Dim>& placed,
                            const Settings& settings);

// Returns for this rank's nodes and ghosts whether d is reduced there; an empty view if there are
// no reductions. Collective.
template <int Dim>
View<char> held_nodes(const Level<Dim>& level, const PlacedSpacing<Dim>& placed);

// The findings of a round from which the next reductions follow.
template <int Dim>
struct Unresolved {
  std::vector<Point<Dim>> places;  // unresolved points of this rank
  // Number of elements with small angles, over all ranks; 0 if elements do not conform.
  std::int64_t small_angles = 0;
  ElementFaults faults;  // faults of the elements of all ranks
  // Whether the elements fill the domain and only cross surfaces inside.
  bool inner_only = false;
};

// Adds the points where d must be smaller because of this round. Returns false if none exist,
// or if the number of rounds is used up.
// Collective.
template <int Dim>
bool add_unresolved_points(const Level<Dim>& level, const Unresolved<Dim>& unresolved,
                           LocalReduction<Dim>& held);

// Returns whether a round with this number of nodes takes far more nodes than the spacing requires.
// The bound is higher if the last round does not conform.
template <int Dim>
bool exceeds_node_growth(double expected_nodes, const LocalReduction<Dim>& held, bool conforms);

// Returns the warning that a round with this number of nodes was not started although elements do
// not conform.
template <int Dim>
Warning warning_of_too_many(double expected_nodes, const LocalReduction<Dim>& held);

// Returns the warning that d is reduced locally, for a run with this number of nodes.
template <int Dim>
Warning warning_of_reduced_spacing(const LocalReduction<Dim>& held, std::int64_t nodes);

}  // namespace pnpbs
