// SPDX-License-Identifier: BSD-3-Clause
// How deep the ghost layers of steps are. Apart from the rest of reach.hpp, because tests put other
// depths in its place (tests/parallel/thin_halo.cpp).
#include <cmath>

#include "level/reach.hpp"

namespace pnpbs {

namespace {

// For so many force evaluations. What an evaluation brings in comes from no farther than the range
// of the force and the ways of both nodes; a hop spans a list radius. Both nodes drift while the
// ghosts stay the same ones.
int hops_for(const Settings& settings, std::int64_t evaluations) {
  const double max = settings.motion.max_move;
  const auto n = static_cast<double>(evaluations);
  const double drift = 2 * max * static_cast<double>(ghost_life(settings));
  const double needed = n * (settings.force_range() + 2 * max) + drift;
  return static_cast<int>(std::ceil(needed / settings.list_radius));
}

}  // namespace

int step_hops(const Settings& settings) {
  return hops_for(settings, settings.exchange_interval * settings.evaluations_per_step());
}

int runge_kutta_hops(const Settings& settings) { return hops_for(settings, kRungeKuttaStages); }

}  // namespace pnpbs
