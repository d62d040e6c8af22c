// SPDX-License-Identifier: BSD-3-Clause
#include "level/finish.hpp"

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"

namespace pnpbs {

// Lists of the present positions, from which visibility is judged from now on.
template <int Dim>
void prepare_finish(Level<Dim>& level) {
  agreed(*level.comm, [&] { level.stars_before.take(level.nodes, level.stars); });
  level.nodes.set_reference_positions();
  exchange(level, kRepairHops<Dim>);
  agreed(*level.comm, [&] { rebuild_lists(level, level.settings.list_radius); });
}

namespace {

template <int Dim>
bool prepared_for_finish(const Level<Dim>& level) {
  return level.nodes.referenced_here() &&
         level.neighbourhood.made_here(level.nodes, level.settings.list_radius) &&
         (!level.distributed() || level.ghosts.are_exact(level.nodes, kRepairHops<Dim>));
}

}  // namespace

// From fresh lists.
template <int Dim>
void make_finish_stars(Level<Dim>& level, StarZone zone) {
  if (!prepared_for_finish(level)) prepare_finish(level);
  make_stars(level, kRepairHops<Dim>, level.settings.list_radius, zone);
}

template void prepare_finish(Level<2>&);
template void prepare_finish(Level<3>&);
template void make_finish_stars(Level<2>&, StarZone);
template void make_finish_stars(Level<3>&, StarZone);

}  // namespace pnpbs
