// SPDX-License-Identifier: BSD-3-Clause
#include "level/reach.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/clearance.hpp"

namespace pnpbs {

double widest_radius(const Settings& settings) {
  return std::max(settings.list_radius, settings.adjacency_radius);
}

double meeting_radius(const Settings& settings) {
  return (settings.dimension == 3 ? kVolumeClearance : kBoundaryClearance) +
         settings.motion.max_move * static_cast<double>(settings.event_interval);
}

double edge_radius(const Settings& settings) {
  return std::max(widest_radius(settings), meeting_radius(settings));
}

std::int64_t ghost_life(const Settings& settings) {
  constexpr std::int64_t kGhostLife = 20;
  return std::max(kGhostLife, settings.exchange_interval);
}

namespace {

// For so many force evaluations. What an evaluation brings in comes from no farther than the range
// of the force and the ways of both nodes; a hop spans a list radius. Both nodes drift while the
// ghosts stay the same ones.
int hops_for(const Settings& settings, std::int64_t evaluations) {
  const double max = settings.motion.max_move;
  const auto n = static_cast<double>(evaluations);
  const double drift = 2 * max * static_cast<double>(ghost_life(settings));
  const double needed = n * (settings.force_range() + 2 * max) + drift;
  const int hops = static_cast<int>(std::ceil(needed / settings.list_radius));
  return std::max(0, hops - static_cast<int>(settings.halo_deficit));
}

}  // namespace

int step_hops(const Settings& settings) {
  return hops_for(settings, settings.exchange_interval * settings.evaluations_per_step());
}

int runge_kutta_hops(const Settings& settings) { return hops_for(settings, kRungeKuttaStages); }

int deepest_hops(const Settings& settings) {
  const int repair_hops = settings.dimension == 3 ? kRepairHops<3> : kRepairHops<2>;
  // One more because nodes drift out of their leaves, and one to see who is beyond.
  return std::max({step_hops(settings), runge_kutta_hops(settings), kPopulationHops, repair_hops}) +
         2;
}

}  // namespace pnpbs
