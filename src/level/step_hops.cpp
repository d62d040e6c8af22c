// SPDX-License-Identifier: BSD-3-Clause
// Depths of the ghosts for steps. They are in a file of their own because tests replace it
// (tests/parallel/thin_halo.cpp).
#include <cmath>

#include "level/reach.hpp"

namespace pnpbs {

namespace {

// Returns the depth for this many evaluations of the force. Each evaluation adds the range of the
// force and the moves of both nodes. A hop spans one list radius. Both nodes also drift as long as
// the same ghosts are kept.
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
