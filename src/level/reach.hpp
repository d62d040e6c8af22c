// SPDX-License-Identifier: BSD-3-Clause
// The ranges that a level needs for its settings: the radii of lists and edges, in units of d, and
// the depths of the ghosts, in hops of the leaf graph.
#pragma once

#include <cstdint>

#include "neighbors/adjacency_list.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// Depth for population events, in hops of the lists; a hop of the leaf graph is longer. A candidate
// checks for room within two hops and has rivals within three, whose bids their owners send. [hops]
inline constexpr int kPopulationHops = 3;
// Depth for repairs of defects, where each rank computes the repairs of its ghosts, three hops
// farther. [hops]
inline constexpr int kDefectHops = 6;
// Depth for lists and for the stars of the owned nodes and their neighbours, where d varies little.
// If stars need nodes farther away, these are fetched. [hops]
inline constexpr int kStarHops = 3;
// The same depth for sweeps and repairs, which read the stars of some neighbours farther and, in
// space, all nodes within a distance of the owned ones. [hops]
inline constexpr int kRepairHops = 4;

// Evaluations of the force in a step of the classical Runge-Kutta scheme of fourth order.
inline constexpr int kRungeKuttaStages = 4;

// Returns the larger of the radii of the lists for steps and of the extracted lists.
double widest_radius(const Settings& settings);
// Returns the distance from an edge up to which a node may come within its clearance before the
// next event.
double meeting_radius(const Settings& settings);
// Returns the distance from a node up to which edges are found.
double edge_radius(const Settings& settings);

// Returns whether ghosts are moved between exchanges. If an exchange follows every evaluation of
// the force, only owned nodes need forces and lists.
bool ghosts_move(const Settings& settings);
// Returns the nodes whose lists steps need.
ListsOf lists_of_steps(const Settings& settings);
// Returns the number of steps after which ghosts are selected again, because nodes drift.
std::int64_t ghost_life(const Settings& settings);
// Return the depth of ghosts that keeps owned nodes exact:
int step_hops(const Settings& settings);         // until the next exchange
int runge_kutta_hops(const Settings& settings);  // in one Runge-Kutta step
int deepest_hops(const Settings& settings);      // in any computation; the tree is refined to it

}  // namespace pnpbs
