// SPDX-License-Identifier: BSD-3-Clause
#include "level/population_events.hpp"

#include <algorithm>

#include "comm/records.hpp"
#include "level/exchange.hpp"
#include "level/finish.hpp"
#include "level/ghost_lists.hpp"
#include "level/lists_and_stars.hpp"
#include "level/plane/elements_on_boundary.hpp"
#include "level/reach.hpp"
#include "level/room.hpp"
#include "level/volume/surface_level.hpp"
#include "method/constants.hpp"
#include "population/free_place.hpp"
#include "quality/plane/defects.hpp"
#include "quality/plane/first_row.hpp"

namespace pnpbs {

template <int Dim>
void delete_nodes(Level<Dim>& level, const std::vector<std::int32_t>& deleted) {
  Nodes<Dim>& nodes = level.nodes;
  constexpr std::int64_t kChunk = 4096;
  View<std::int32_t>& stay = nodes.order_scratch();
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

// Returns the position of a new bubble beside node i.
Point<2> place_beside(const Level<2>& level, std::int64_t i) {
  return level.nodes.cell.rounded(free_place<2>(level.nodes, level.lists(), i));
}
Point<3> place_beside(const Level<3>& level, std::int64_t i) {
  return level.nodes.cell.rounded(level.nodes.moving == Carrier::surface
                                      ? free_place_on_surface(level, i)
                                      : free_place<3>(level.nodes, level.lists(), i));
}

// Finds the facets that new bubbles lie on, while the indices of their parents are valid.
void find_carriers(const Level<2>&, PopulationChange<2>&) {}
void find_carriers(const Level<3>& level, PopulationChange<3>& change) {
  if (level.nodes.moving != Carrier::surface) return;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    change.born[k].boundary_node = facet_at(level, change.parents[k], change.born[k].position);
}

std::int32_t tag_of_birth(const Level<2>&, const Birth<2>&) { return 0; }
std::int32_t tag_of_birth(const Level<3>& level, const Birth<3>& birth) {
  if (birth.boundary_node < 0) return 0;
  return level.geometry.boundary().facets[static_cast<std::size_t>(birth.boundary_node)].tag;
}

// Replaces the positions of new nodes of a periodic domain by those in its cell.
template <int Dim>
void put_in_cell(const Level<Dim>& level, std::vector<Birth<Dim>>& born) {
  const PeriodicCell<Dim>& cell = level.nodes.cell;
  if (!cell.any()) return;
  for (Birth<Dim>& birth : born) {
    const Point<Dim> x = cell.rounded(birth.position);
    birth.boundary_node = level.geometry.boundary_seen_from(cell.image_of(x), level.nodes.moving,
                                                            birth.boundary_node);
    birth.position = cell.in_cell(x);
  }
}

// The owner of the leaf that contains a new node assigns its id. Ids follow the Morton order of the
// buckets, then the parent, then the position, so that they do not depend on threads or ranks.
template <int Dim>
void number_births(Level<Dim>& level, std::vector<Birth<Dim>> born) {
  const BackgroundTree<Dim>& tree = level.tree->tree();
  const PeriodicCell<Dim>& cell = level.nodes.cell;
  put_in_cell(level, born);
  if (level.distributed())
    born = redistribute<Birth<Dim>>(*level.comm, born, [&](const Birth<Dim>& birth) {
      return level.tree->owner_at(birth.position);
    });
  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Birth<Dim>& birth : born)
    ++new_ids[static_cast<std::size_t>(tree.leaf_at(birth.position))];
  std::vector<std::int64_t> next =
      level.tree->distribution().prefix_sums(*level.comm, std::move(new_ids), level.next_id);
  std::sort(born.begin(), born.end(), [](const Birth<Dim>& a, const Birth<Dim>& b) {
    return a.parent < b.parent || (a.parent == b.parent && a.position < b.position);
  });
  for (const Birth<Dim>& birth : born)
    level.nodes.append(birth.position, birth.d,
                       cell.id_of(next[static_cast<std::size_t>(tree.leaf_at(birth.position))]++),
                       tag_of_birth(level, birth), level.nodes.moving, birth.boundary_node);
}

// Receives the bids of ghosts from their owners, because only an owner knows everything that a bid
// depends on. Collective.
template <int Dim>
void receive_ghost_bids(const Level<Dim>& level, const std::vector<std::int32_t>& bidders,
                        const View<Bid<Dim>>& bids) {
  if (!level.distributed()) return;
  const Nodes<Dim>& nodes = level.nodes;
  std::vector<Bid<Dim>> told = level.ghosts.template tell<Bid<Dim>>(
      *level.comm, nodes, bidders, [&](std::int32_t i) { return std::vector<Bid<Dim>>{bids(i)}; });
  std::ranges::sort(told, {}, &Bid<Dim>::id);
  for_each("pnpbs::receive_ghost_bids", nodes.count, [&](std::int64_t i) {
    if (nodes.owned(i)) return;
    const auto bid = std::ranges::lower_bound(told, nodes.id(i), {}, &Bid<Dim>::id);
    if (bid != told.end() && bid->id == nodes.id(i)) bids(i) = *bid;
  });
}

template <int Dim>
PopulationCounts carry_out(Level<Dim>& level, PopulationChange<Dim> change) {
  Nodes<Dim>& nodes = level.nodes;
  find_carriers(level, change);
  // Owners count their own nodes. The owner of the parent counts and sends an insertion.
  PopulationCounts counts;
  std::vector<Birth<Dim>> born;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    if (nodes.owned(change.parents[k])) born.push_back(change.born[k]);
  for (std::int32_t i : change.deleted) counts.deleted += nodes.owned(i);
  counts.inserted = static_cast<std::int64_t>(born.size());
  const std::uint64_t inserted =
      level.comm->allreduce_sum(static_cast<std::uint64_t>(counts.inserted));
  const std::uint64_t deleted =
      level.comm->allreduce_sum(static_cast<std::uint64_t>(counts.deleted));
  if (inserted + deleted == 0) return counts;  // changes of ghosts do not count
  delete_nodes(level, change.deleted);
  if (inserted > 0) number_births(level, std::move(born));
  exchange(level, step_hops(level.settings));
  return counts;
}

// Returns the bids of all nodes: computes those of owned nodes, and receives those of ghosts.
// Collective.
template <int Dim>
View<Bid<Dim>> gather_bids(Level<Dim>& level, const View<double>& ratios,
                           const PopulationThresholds& thresholds,
                           std::vector<std::int32_t>& bidders) {
  const Nodes<Dim>& nodes = level.nodes;
  const PopulationRule& rule = level.settings.population;
  View<Bid<Dim>> bids;
  collective_try(*level.comm, [&] {
    add_lists_around(level, owned_beside_gaps<Dim>(nodes, ratios, rule, thresholds), kRoomHops - 1);
    const View<char> no_room = nodes_without_room(level);
    bids = bids_of_owned<Dim>(
        nodes, level.lists(), ratios, rule, thresholds,
        [&](std::int64_t i) { return no_room(i) != 0; },
        [&](std::int64_t i) { return place_beside(level, i); },
        [&](const Point<Dim>& x, double d) { return has_clearance(level, x, d); });
    bidders = own_bidders<Dim>(nodes, bids);
  });
  receive_ghost_bids(level, bidders, bids);
  return bids;
}

}  // namespace

template <int Dim>
PopulationCounts adjust_population(Level<Dim>& level, double tolerance) {
  const PhaseTimer timer(level.timers, Phase::population);
  const Nodes<Dim>& nodes = level.nodes;
  level.nodes.set_reference_positions();
  // Deep enough also for the steps that follow if nothing changes.
  exchange(level, std::max(kPopulationHops, step_hops(level.settings)));
  View<double> ratios;
  collective_try(*level.comm, [&] {
    rebuild_lists_for_steps(level, lists_of_steps(level.settings));
    ratios = overlap_ratios<Dim>(nodes, level.lists());
  });
  const PopulationThresholds thresholds = choose_thresholds<Dim>(
      *level.comm, nodes, level.lists(), ratios, level.settings.population, tolerance);
  std::vector<std::int32_t> bidders;
  const View<Bid<Dim>> bids = gather_bids(level, ratios, thresholds, bidders);
  PopulationChange<Dim> change;
  collective_try(*level.comm, [&] {
    add_lists_around(level, bidders, method::kContestHops - 1);
    change = outcome_of_contest<Dim>(nodes, level.lists(), bids, bidders);
    count_uses_by_event(level, kPopulationHops);
  });
  return carry_out(level, std::move(change));
}

PopulationCounts repair_defects(Level<2>& level) {
  const PhaseTimer timer(level.timers, Phase::population);
  level.nodes.set_reference_positions();
  exchange(level, kDefectHops);
  make_lists_and_stars(level, kDefectHops, level.settings.list_radius, {kDefectRings});
  count_uses_by_event(level, kDefectHops);
  PopulationChange<2> change;
  collective_try(*level.comm, [&] {
    change = choose_defect_repairs(
        level.nodes, level.stars, level.settings.defects.bad_below,
        [&](const Point<2>& x, double d) { return has_clearance(level, x, d); });
  });
  return carry_out(level, std::move(change));
}

// Defects are recognized by the cyclic order of the neighbours, which stars in space do not have.
PopulationCounts repair_defects(Level<3>&) { return {}; }

PopulationCounts place_first_row(Level<2>& level) {
  const PhaseTimer timer(level.timers, Phase::population);
  require_finish_lists(level);
  PopulationChange<2> change;
  collective_try(*level.comm, [&] {
    FirstRow row =
        choose_first_row(level.nodes, level.lists(), level.map(), level.geometry.sectors(),
                         [&](std::int32_t b) { return level.geometry.boundary_spacing(b); });
    count_uses_by_event(level, kFirstRowHops);
    for (const FirstRow::Move& move : row.moved) level.nodes.set_position(move.node, move.to);
    level.nodes.moved();
    change = std::move(row.change);
  });
  return carry_out(level, std::move(change));
}

PopulationCounts place_first_row(Level<3>&) { return {}; }

PopulationCounts split_elements_on_boundary(Level<2>& level) {
  const PhaseTimer timer(level.timers, Phase::population);
  make_finish_stars(level, {});
  PopulationChange<2> change;
  collective_try(*level.comm, [&] { change = nodes_in_elements_on_boundary(level); });
  return carry_out(level, std::move(change));
}

PopulationCounts split_elements_on_boundary(Level<3>&) { return {}; }

template void delete_nodes(Level<2>&, const std::vector<std::int32_t>&);
template void delete_nodes(Level<3>&, const std::vector<std::int32_t>&);
template PopulationCounts adjust_population(Level<2>&, double);
template PopulationCounts adjust_population(Level<3>&, double);

}  // namespace pnpbs
