// SPDX-License-Identifier: BSD-3-Clause
#include "level/population_events.hpp"

#include <algorithm>

#include "comm/records.hpp"
#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"
#include "level/room.hpp"
#include "quality/plane/defects.hpp"

namespace pnpbs {

void delete_nodes(Level& level, const std::vector<std::int32_t>& deleted) {
  Nodes<2>& nodes = level.nodes;
  constexpr std::int64_t kChunk = 4096;
  const View<std::int32_t> stay = nodes.order_scratch();
  const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
  for_each("pnpbs::delete_nodes", chunks, [&](std::int64_t chunk) {
    auto next = std::lower_bound(deleted.begin(), deleted.end(), chunk * kChunk);
    for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes.count); ++i) {
      if (next != deleted.end() && *next == i)
        ++next;
      else
        stay(i - (next - deleted.begin())) = static_cast<std::int32_t>(i);
    }
  });
  level.neighbourhood.keep_nodes(nodes, stay,
                                 nodes.count - static_cast<std::int64_t>(deleted.size()));
}

namespace {

// The owner of the leaf a node is born in numbers it: ids by bucket in Morton order, then by
// parent, so that no order of threads or ranks comes in.
void number_births(Level& level, std::vector<Birth<2>> born) {
  const BackgroundTree<2>& tree = level.tree->tree();
  if (level.distributed())
    born = redistribute<Birth<2>>(*level.comm, born, [&](const Birth<2>& birth) {
      return level.tree->owner_at(birth.position);
    });
  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Birth<2>& birth : born)
    ++new_ids[static_cast<std::size_t>(tree.leaf_at(birth.position))];
  std::vector<std::int64_t> next =
      level.tree->distribution().prefix_sums(*level.comm, std::move(new_ids), level.next_id);
  std::sort(born.begin(), born.end(),
            [](const Birth<2>& a, const Birth<2>& b) { return a.parent < b.parent; });
  for (const Birth<2>& birth : born)
    level.nodes.append(birth.position, birth.d,
                       next[static_cast<std::size_t>(tree.leaf_at(birth.position))]++, 0,
                       Carrier::free, -1);
}

PopulationCounts carry_out(Level& level, PopulationChange<2> change) {
  Nodes<2>& nodes = level.nodes;
  const PhaseTimer timer(level.timers, Phase::population);
  // Each is its owner's to count and to number, a birth the parent's owner's.
  PopulationCounts counts;
  std::vector<Birth<2>> born;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    if (nodes.owned(change.parents[k])) born.push_back(change.born[k]);
  for (std::int32_t i : change.deleted) counts.deleted += nodes.owned(i);
  counts.inserted = static_cast<std::int64_t>(born.size());
  const std::uint64_t inserted =
      level.comm->allreduce_sum(static_cast<std::uint64_t>(counts.inserted));
  const std::uint64_t deleted =
      level.comm->allreduce_sum(static_cast<std::uint64_t>(counts.deleted));
  if (inserted + deleted == 0)
    return counts;  // what ghosts at the border seem to do does not count
  delete_nodes(level, change.deleted);
  if (inserted > 0) number_births(level, std::move(born));
  exchange(level, step_hops(level.settings));
  return counts;
}

}  // namespace

PopulationCounts adjust_population(Level& level, double tolerance) {
  const Nodes<2>& nodes = level.nodes;
  level.nodes.set_reference_positions();
  exchange(level, kPopulationHops);
  PopulationChange<2> change;
  const PopulationRule<2>& rule = level.settings.population;
  View<double> ratios;
  agreed(*level.comm, [&] {
    rebuild_lists_for_steps(level);
    const PhaseTimer timer(level.timers, Phase::population);
    ratios = overlap_ratios<2>(nodes, level.lists());
  });
  const PopulationThresholds thresholds =
      choose_thresholds<2>(*level.comm, nodes, level.lists(), ratios, rule, tolerance);
  agreed(*level.comm, [&] {
    const PhaseTimer timer(level.timers, Phase::population);
    const View<char> no_room = nodes_without_room(level);
    change = choose_population_change<2>(
        nodes, level.lists(), ratios, rule, thresholds,
        [&](std::int64_t i) { return no_room(i) != 0; },
        [&](const Point<2>& x, double d) { return has_clearance(level, x, d); });
  });
  return carry_out(level, std::move(change));
}

PopulationCounts repair_defects(Level& level) {
  level.nodes.set_reference_positions();
  exchange(level, kPopulationHops);
  make_lists_and_stars(level, kPopulationHops, level.settings.list_radius, kDefectRings);
  PopulationChange<2> change;
  agreed(*level.comm, [&] {
    const PhaseTimer timer(level.timers, Phase::population);
    change = choose_defect_repairs(
        level.nodes, level.stars, level.settings.defects.bad_below,
        [&](const Point<2>& x, double d) { return has_clearance(level, x, d); });
  });
  return carry_out(level, std::move(change));
}

}  // namespace pnpbs
