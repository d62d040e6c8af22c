// SPDX-License-Identifier: BSD-3-Clause
#include "level/reach.hpp"

#include <algorithm>

#include "geometry/clearance.hpp"
#include "method/constants.hpp"

namespace pnpbs {

double widest_radius(const Settings& settings) {
  return std::max(settings.list_radius, settings.adjacency_radius);
}

double meeting_radius(const Settings& settings) {
  return (settings.bubble_dimension == 3 ? method::kVolumeClearance : method::kBoundaryClearance) +
         settings.motion.max_move * static_cast<double>(settings.event_interval);
}

double edge_radius(const Settings& settings) {
  return std::max(widest_radius(settings), meeting_radius(settings));
}

bool ghosts_move(const Settings& settings) {
  return settings.exchange_interval * settings.evaluations_per_step() > 1;
}

ListsOf lists_of_steps(const Settings& settings) {
  return ghosts_move(settings) ? ListsOf::all_nodes : ListsOf::owned_nodes;
}

std::int64_t ghost_life(const Settings& settings) {
  constexpr std::int64_t kGhostLife = 20;
  return std::max(kGhostLife, settings.exchange_interval);
}

int deepest_hops(const Settings& settings) {
  // Two more: nodes drift out of their leaves, and the neighbours beyond must be known.
  return std::max({step_hops(settings), runge_kutta_hops(settings), kPopulationHops, kDefectHops,
                   kRepairHops}) +
         2;
}

}  // namespace pnpbs
