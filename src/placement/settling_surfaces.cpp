// SPDX-License-Identifier: BSD-3-Clause
// In space, what has the least freedom comes first: nodes on feature edges lie where d asks for
// them, those on surfaces rest as bubbles that cannot leave their surface, and then the inside is
// filled. On every level the same loop of steps and events moves one after the other.
#include <algorithm>
#include <cmath>
#include <utility>

#include "initial/initial_fill.hpp"
#include "level/exchange.hpp"
#include "level/expected_nodes.hpp"
#include "level/numbering.hpp"
#include "level/volume/surface_level.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

// The nodes of the boundary among those given, which may be from a coarser level, come to rest on
// the level's surfaces, and are given instead; if there are none, the surfaces are filled.
// If the monitor has stopped the call, or does so here, they stay as they are. Collective.
template <>
void PlacementOf<3>::settle_surfaces(std::unique_ptr<Level<3>>& level, GivenNodes<3>& given,
                                     Outcome& outcome) {
  scatter_to_owners(*level, given);
  reserve_ids(*level, given);
  GivenNodes<3> inner, on_surfaces, on_features;
  for (const GivenNode<3>& node : given)
    (node.is_inner()                    ? inner
     : node.carrier == Carrier::surface ? on_surfaces
                                        : on_features)
        .push_back(node);
  const bool anew = comm_->allreduce_sum(on_surfaces.size()) == 0;
  const Settings inside = level->settings;
  const Schedule schedule = schedule_;
  std::swap(level_, level);  // the time loop is that of the level there is
  const auto restore = [&] {
    schedule_ = schedule;
    std::swap(level_, level);
  };
  try {
    level_->change_settings(surface_settings(inside));
    put_surface_nodes(*level_, std::move(on_surfaces), on_features, anew);
    begin_schedule(!anew);
    schedule_.coarser = true;
    const Settings& settings = level_->settings;
    if (outcome != Outcome::stopped &&
        advance(anew ? settings.steps : settings.refined_steps, {0, 0}) == Outcome::stopped)
      outcome = Outcome::stopped;
    if (outcome != Outcome::stopped) sweep_on_surfaces(*level_, settings.sweeps);
    fix_surface_nodes(*level_);
    level_->change_settings(inside);
  } catch (...) {
    restore();
    throw;
  }
  restore();
  given = surface_nodes(*level);
  scatter_to_owners(*level, given);  // some have moved on since the last exchange
  given.insert(given.end(), inner.begin(), inner.end());
}

// Coarser levels from which the nodes on surfaces come: where these are flat and d is even there,
// one lattice fills each; else a few.
template <>
int PlacementOf<3>::surface_levels_that_pay(const Level<3>& finest) const {
  constexpr double kMinNodes = 100;  // on the surfaces of the coarsest
  const Surface& surface = finest.ground.surface();
  bool flat = true;
  for (std::int32_t p = 0; p < surface.features().patches; ++p) flat = flat && surface.is_flat(p);
  const SpacingVariation d = spacing_variation(finest);
  if (flat && d.max <= kPatchVariation * d.min) return 0;
  const double nodes = 1.15 * domain_->area() / (d.max * d.max);
  int levels = 0;
  while (levels < finest.settings.levels && nodes >= kMinNodes * std::ldexp(1.0, 2 * levels + 2))
    ++levels;
  return levels;
}

}  // namespace pnpbs
