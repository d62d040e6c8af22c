// SPDX-License-Identifier: BSD-3-Clause
// How far a level looks, by its settings: the radii of lists and edges, in units of d, and the hops
// of the leaf graph that ghosts must reach.
#pragma once

#include <cstdint>

#include "neighbors/adjacency_list.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// In hops of the lists: a candidate looks two hops far for room, and may not act if a stronger one
// is within three; what those bid their owners tell. A hop of the leaf graph is the longer one.
inline constexpr int kPopulationHops = 3;
// The same where each rank finds itself what its ghosts do, three hops farther.
inline constexpr int kDefectHops = 6;
// For the stars of our nodes and their neighbours, and for lists of any radius, where d is even;
// what they need farther away is asked for, and then all stars are found again.
inline constexpr int kStarHops = 3;
// The same for the stars that sweeps and repairs look at, some neighbours farther away. In space
// spheres are larger over d than circles in the plane: with 5, a graded cube asks in each repair.
template <int Dim>
inline constexpr int kRepairHops = Dim == 2 ? 4 : 6;

// Evaluations of the force in a step of the classical fourth order.
inline constexpr int kRungeKuttaStages = 4;

// The larger one of the lists' radius and of that of the adjacency lists.
double widest_radius(const Settings& settings);
// Nodes this near to an edge may come within its clearance until the next event.
double meeting_radius(const Settings& settings);
// Edges this near to a node are known.
double edge_radius(const Settings& settings);

// Do ghosts move between exchanges? Where those follow each evaluation of the force, only owned
// nodes need it, and lists.
bool ghosts_move(const Settings& settings);
// The lists that steps need.
ListsOf lists_of_steps(const Settings& settings);
// Steps after which ghosts are chosen anew, because nodes drift.
std::int64_t ghost_life(const Settings& settings);
// How many hops ghosts must reach for owned nodes to stay exact:
int step_hops(const Settings& settings);         // over the steps until the next exchange
int runge_kutta_hops(const Settings& settings);  // over the stages of one step
int deepest_hops(const Settings& settings);      // over anything; the tree is refined so far

}  // namespace pnpbs
