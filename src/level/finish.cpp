// SPDX-License-Identifier: BSD-3-Clause
#include "level/finish.hpp"

#include "level/exchange.hpp"
#include "level/ghost_lists.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

template <int Dim>
bool prepared_for_finish(const Level<Dim>& level) {
  return level.nodes.referenced_here() &&
         level.neighbourhood.built_here(level.nodes, level.settings.list_radius) &&
         (!level.distributed() || level.ghosts.are_exact(level.nodes, kRepairHops));
}

}  // namespace

// The lists are built for the present positions, which become the reference positions for
// visibility.
template <int Dim>
void require_finish_lists(Level<Dim>& level) {
  if (prepared_for_finish(level)) return;
  take_stars(level);
  level.nodes.set_reference_positions();
  exchange(level, kRepairHops);
  collective_try(*level.comm,
                 [&] { rebuild_lists(level, level.settings.list_radius, lists_of_stars(level)); });
}

// Stars are expensive in space, so they are kept if nothing has moved since they were found.
template <int Dim>
void make_finish_stars(Level<Dim>& level, GhostStarDepth zone) {
  require_finish_lists(level);
  const bool of_owned = Dim == 3 && zone.rings == 0 && zone.reach == 0;
  if (of_owned && level.finish_stars == level.version() && !level.changed_labels.any()) return;
  make_stars(level, kRepairHops, level.settings.list_radius, zone);
  level.finish_stars = of_owned ? level.version() : -1;
}

template void require_finish_lists(Level<2>&);
template void require_finish_lists(Level<3>&);
template void make_finish_stars(Level<2>&, GhostStarDepth);
template void make_finish_stars(Level<3>&, GhostStarDepth);

}  // namespace pnpbs
