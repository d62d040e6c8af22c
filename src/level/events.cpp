// SPDX-License-Identifier: BSD-3-Clause
// What happens to a level at events: refresh of d, population, speeds.
#include <algorithm>
#include <cmath>

#include "comm/records.hpp"
#include "level/level.hpp"
#include "population/population.hpp"
#include "quality/plane/defects.hpp"

namespace pnpbs {

// At the places of the nodes; what is at those of ghosts means nothing. The spacing is asked
// equally often on all ranks: it may live distributed over them. Collective.
View<double> Level::spacing_at_owned_nodes(const Spacing<2>& spacing) const {
  constexpr std::int64_t kBatch = 1 << 14;  // bounds the memory for the points handed out
  const std::int64_t last =
      static_cast<std::int64_t>(comm_->allreduce_max(static_cast<double>(nodes_.count)));
  View<double> all;
  agreed(*comm_, [&] {
    all = make_view<double>("pnpbs::Level::spacings", nodes_.count);
    std::vector<std::int32_t> owned;
    std::vector<Point<2>> x;
    std::vector<double> d;
    const auto most = static_cast<std::size_t>(std::min(kBatch, nodes_.count));
    owned.reserve(most);
    x.reserve(most);
    d.reserve(most);
    for (std::int64_t first = 0; first < last; first += kBatch) {
      owned.clear();
      for (std::int64_t i = first; i < std::min(first + kBatch, nodes_.count); ++i)
        if (nodes_.owned(i)) owned.push_back(static_cast<std::int32_t>(i));
      x.resize(owned.size());
      d.resize(owned.size());
      const auto n = static_cast<std::int64_t>(owned.size());
      for_each("pnpbs::Level::points_for_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        x[at] = nodes_.position(owned[at]);
      });
      evaluate_spacing<2>(spacing, domain_->area(), n, x.data(), d.data());
      for_each("pnpbs::Level::take_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        all(owned[at]) = d[at];
      });
    }
  });
  return all;
}

// By the owners; ghosts get theirs with the next exchange. If the callback fails, all stays as it
// is.
void Level::refresh_spacing() {
  ++version_;
  const PhaseTimer timer(timers_, Phase::spacing);
  const View<double> d = spacing_at_owned_nodes(*spacing_);
  for_each("pnpbs::Level::refresh_spacing", nodes_.count, [&](std::int64_t i) {
    if (!nodes_.owned(i)) return;
    nodes_.d(i) = d(i);
    if (nodes_.moves(i)) return;
    const auto b = static_cast<std::size_t>(nodes_.boundary_node(i));
    nodes_.d(i) = std::min(d(i), boundary_bound_[b]);
  });
  set_reference_positions();
  ghost_hops_ = 0;
}

void Level::exchange_for_stars() { exchange(kStarHops); }

PopulationCounts Level::adjust_population(double tolerance) {
  ++version_;
  set_reference_positions();
  exchange(kPopulationHops);
  PopulationChange<2> change;
  const PopulationRule<2>& rule = settings_.population;
  View<double> ratios;
  agreed(*comm_, [&] {
    rebuild_lists();
    const PhaseTimer timer(timers_, Phase::population);
    ratios = overlap_ratios<2>(nodes_, lists_);
  });
  const PopulationThresholds thresholds =
      choose_thresholds<2>(*comm_, nodes_, lists_, ratios, rule, tolerance);
  agreed(*comm_, [&] {
    const PhaseTimer timer(timers_, Phase::population);
    const View<char> no_room = nodes_without_room();
    change = choose_population_change<2>(
        nodes_, lists_, ratios, rule, thresholds, [&](std::int64_t i) { return no_room(i) != 0; },
        [this](const Point<2>& x, double d) { return has_clearance(x, d); });
  });
  return carry_out(std::move(change));
}

PopulationCounts Level::repair_defects() {
  ++version_;
  set_reference_positions();
  exchange(kPopulationHops);
  make_lists_and_stars(kPopulationHops, settings_.list_radius, kDefectRings);
  PopulationChange<2> change;
  agreed(*comm_, [&] {
    const PhaseTimer timer(timers_, Phase::population);
    change =
        choose_defect_repairs(nodes_, stars_, settings_.defects.bad_below,
                              [this](const Point<2>& x, double d) { return has_clearance(x, d); });
  });
  return carry_out(std::move(change));
}

PopulationCounts Level::carry_out(PopulationChange<2> change) {
  const PhaseTimer timer(timers_, Phase::population);
  // Each is its owner's to count and to number, a birth the parent's owner's.
  PopulationCounts counts;
  std::vector<Birth<2>> born;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    if (nodes_.owned(change.parents[k])) born.push_back(change.born[k]);
  for (std::int32_t i : change.deleted) counts.deleted += nodes_.owned(i);
  counts.inserted = static_cast<std::int64_t>(born.size());
  const std::uint64_t inserted = comm_->allreduce_sum(static_cast<std::uint64_t>(counts.inserted));
  const std::uint64_t deleted = comm_->allreduce_sum(static_cast<std::uint64_t>(counts.deleted));
  if (inserted + deleted == 0) return counts;  // what ghosts at the rim seem to do does not count
  delete_nodes(change.deleted);
  if (inserted > 0) number_births(std::move(born));
  lists_valid_ = false;
  exchange(step_hops());
  return counts;
}

void Level::delete_nodes(const std::vector<std::int32_t>& deleted) {
  constexpr std::int64_t kChunk = 4096;
  const View<std::int32_t> stay = nodes_.order_scratch();
  const std::int64_t chunks = (nodes_.count + kChunk - 1) / kChunk;
  for_each("pnpbs::Level::delete_nodes", chunks, [&](std::int64_t chunk) {
    auto next = std::lower_bound(deleted.begin(), deleted.end(), chunk * kChunk);
    for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes_.count); ++i) {
      if (next != deleted.end() && *next == i)
        ++next;
      else
        stay(i - (next - deleted.begin())) = static_cast<std::int32_t>(i);
    }
  });
  keep_nodes(stay, nodes_.count - static_cast<std::int64_t>(deleted.size()));
}

void Level::keep_nodes(const View<std::int32_t>& places, std::int64_t kept) {
  nodes_.keep(places, kept);
  buckets_.keep(places, kept);
}

// The owner of the leaf a node is born in numbers it: ids by bucket in Morton order, then by
// parent, so that no order of threads or ranks comes in.
void Level::number_births(std::vector<Birth<2>> born) {
  const BackgroundTree<2>& tree = map_.tree();
  if (distributed())
    born = redistribute<Birth<2>>(*comm_, born, [&](const Birth<2>& birth) {
      return distribution_.owner_at(birth.position);
    });
  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Birth<2>& birth : born)
    ++new_ids[static_cast<std::size_t>(tree.leaf_at(birth.position))];
  std::vector<std::int64_t> next = distribution_.prefix_sums(*comm_, std::move(new_ids), next_id_);
  std::sort(born.begin(), born.end(),
            [](const Birth<2>& a, const Birth<2>& b) { return a.parent < b.parent; });
  for (const Birth<2>& birth : born)
    nodes_.append(birth.position, birth.d,
                  next[static_cast<std::size_t>(tree.leaf_at(birth.position))]++, 0, -1);
}

Speeds Level::speeds() const {
  const auto scaled = [this](std::int64_t i) {
    return std::sqrt(nodes_.v[0](i) * nodes_.v[0](i) + nodes_.v[1](i) * nodes_.v[1](i)) /
           nodes_.d(i);
  };
  Speeds speeds;
  speeds.largest = comm_->allreduce_max(
      largest_of("pnpbs::Level::largest_speed", nodes_.count, 0.0,
                 [&](std::int64_t i) { return nodes_.owned(i) ? scaled(i) : 0.0; }));
  const std::uint64_t sum = sum_of("pnpbs::Level::mean_speed", nodes_.count, [&](std::int64_t i) {
    return nodes_.owned(i) ? fixed_point(scaled(i)) : 0;
  });
  const auto all =
      static_cast<std::int64_t>(comm_->allreduce_sum(static_cast<std::uint64_t>(owned_count())));
  const std::int64_t moving = std::max<std::int64_t>(1, all - boundary_nodes());
  speeds.mean = from_fixed_point(comm_->allreduce_sum(sum)) / static_cast<double>(moving);
  return speeds;
}

}  // namespace pnpbs
