// SPDX-License-Identifier: BSD-3-Clause
// What happens to a level at events: refresh of d, population, stars, sweeps.
#include <algorithm>
#include <cmath>

#include "core/level.hpp"
#include "forces/population.hpp"
#include "geometry/keep_off.hpp"
#include "geometry/segments.hpp"
#include "parallel/records.hpp"
#include "stars/sweep.hpp"

namespace pnpbs {

// In the order of memory. The spacing is asked equally often on all ranks: it may live distributed
// over them. Collective.
std::vector<double> Level::spacing_at_owned_nodes(const Spacing<2>& spacing) const {
  constexpr std::int64_t kBatch = 1 << 16;  // bounds the memory for the points handed out
  const std::int64_t last =
      static_cast<std::int64_t>(comm_->largest(static_cast<double>(nodes_.count)));
  std::vector<double> all;
  agreed(*comm_, [&] {
    std::vector<Point<2>> x;
    all.reserve(static_cast<std::size_t>(nodes_.count));
    for (std::int64_t first = 0; first < last; first += kBatch) {
      x.clear();
      for (std::int64_t i = first; i < std::min(first + kBatch, nodes_.count); ++i)
        if (nodes_.owned(i)) x.push_back(nodes_.position(i));
      const std::size_t before = all.size();
      all.resize(before + x.size());
      evaluate_spacing<2>(spacing, domain_->area(), static_cast<std::int64_t>(x.size()), x.data(),
                          all.data() + before);
    }
  });
  return all;
}

// By the owners; ghosts get theirs with the next exchange. If the callback fails, all stays as it
// is.
void Level::refresh_spacing() {
  ++version_;
  const PhaseTimer timer(timers_, Phase::spacing);
  const std::vector<double> d = spacing_at_owned_nodes(*spacing_);
  std::size_t owned = 0;
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.owned(i)) nodes_.d(i) = d[owned++];
  drop_anchors();
  ghost_hops_ = 0;
}

namespace {

constexpr double kNearlyCoincide = 0.2;  // in units of d

// Has any node of block b a listed neighbour within so many of its d?
bool any_within(const Nodes<2>& nodes, const AdjacencyList<2>& lists, double reach,
                std::int64_t b) {
  const Positions<2> x = positions_of<2>(nodes.x);
  std::int64_t self[kLanes];
  block_nodes(b, nodes.count, self);
  double own[2][kLanes], square_reach[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int k = 0; k < 2; ++k) own[k][lane] = x[k][self[lane]];
    square_reach[lane] = reach * reach * nodes.d(self[lane]) * nodes.d(self[lane]);
  }
  const ListBlock list = lists.block(b);
  const std::int32_t* entries = list.entries;
  double within = -1;
  for (std::int32_t n = 0; n < list.length; ++n, entries += kLanes) {
#pragma omp simd reduction(max : within)
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t j = entries[lane];
      const double dx = own[0][lane] - x[0][j], dy = own[1][lane] - x[1][j];
      within = std::max(within, square_reach[lane] - (dx * dx + dy * dy));
    }
  }
  return within >= 0;
}

}  // namespace

// The nodes with smaller ids that node i nearly coincides with: those push it no more.
template <class Visit>
void Level::for_coinciding(std::int64_t i, const Visit& visit) const {
  const Point<2> x = nodes_.position(i);
  lists_.for_neighbours(i, [&](std::int64_t j) {
    if (nodes_.moves(j) && nodes_.id(j) < nodes_.id(i) &&
        distance<2>(x, nodes_.position(j)) < kNearlyCoincide * nodes_.d(i))
      visit(j);
  });
}

bool Level::between_edges(std::int64_t i) const {
  double gap = kFarAway;
  for (std::int32_t e : near_edges_.edges_of(i))
    gap = std::min(gap,
                   distance_to_segment(map_.edge_begin(e), map_.edge_end(e), nodes_.position(i)));
  return gap < kLeastClearance * nodes_.d(i);
}

// Between boundary edges, or on top of another node: of two that nearly coincide the one with the
// larger id.
bool Level::has_no_room(std::int64_t i) const {
  bool room = !between_edges(i);
  for_coinciding(i, [&](std::int64_t) { room = false; });
  return !room;
}

void Level::exchange_for_stars() { exchange(kStarHops); }

PopulationCounts Level::adjust_population(double refill) {
  ++version_;
  drop_anchors();
  exchange(kPopulationHops);
  PopulationChange<2> change;
  agreed(*comm_, [&] {
    rebuild_lists();
    const PhaseTimer timer(timers_, Phase::population);
    PopulationRule rule = settings_.population;
    rule.insert_below = std::max(rule.insert_below, refill);
    change = choose_population_change<2>(
        nodes_, lists_, rule, [this](std::int64_t i) { return has_no_room(i); },
        [this](const Point<2>& x, double d) { return fits(x, d); });
  });
  const PhaseTimer timer(timers_, Phase::population);
  // Each is its owner's to count and to number, a birth the parent's owner's.
  PopulationCounts counts;
  std::vector<Birth<2>> born;
  for (std::size_t k = 0; k < change.born.size(); ++k)
    if (nodes_.owned(change.parents[k])) born.push_back(change.born[k]);
  for (std::int32_t i : change.deleted) counts.deleted += nodes_.owned(i);
  counts.inserted = static_cast<std::int64_t>(born.size());
  const std::uint64_t inserted = comm_->sum(static_cast<std::uint64_t>(counts.inserted));
  const std::uint64_t deleted = comm_->sum(static_cast<std::uint64_t>(counts.deleted));
  if (inserted + deleted == 0) return counts;  // what ghosts at the rim seem to do does not count
  delete_nodes(change.deleted);
  if (inserted > 0) number_births(std::move(born));
  lists_valid_ = false;
  exchange(step_hops());
  return counts;
}

void Level::delete_nodes(const std::vector<std::int32_t>& deleted) {
  const View<std::int32_t> stay = nodes_.order_scratch();
  std::int64_t kept = 0;
  std::size_t next = 0;
  for (std::int32_t i = 0; i < nodes_.count; ++i) {
    if (next < deleted.size() && deleted[next] == i)
      ++next;
    else
      stay(kept++) = i;
  }
  nodes_.keep(stay, kept);
  in_buckets_ = false;
}

// The owner of the leaf a node is born in numbers it: ids by bucket in Morton order, then by
// parent, so that no order of threads or ranks comes in.
void Level::number_births(std::vector<Birth<2>> born) {
  const BackgroundTree<2>& tree = map_.tree();
  if (distributed())
    born = delivered<Birth<2>>(*comm_, born, [&](const Birth<2>& birth) {
      return distribution_.owner_at(birth.position);
    });
  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Birth<2>& birth : born)
    ++new_ids[static_cast<std::size_t>(tree.leaf_at(birth.position))];
  std::vector<std::int64_t> next = distribution_.prefix_sums(*comm_, std::move(new_ids), next_id_);
  std::sort(born.begin(), born.end(),
            [](const Birth<2>& a, const Birth<2>& b) { return a.parent < b.parent; });
  in_buckets_ = false;
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
  speeds.largest =
      comm_->largest(largest_of("pnpbs::Level::largest_speed", nodes_.count, 0.0,
                                [&](std::int64_t i) { return nodes_.owned(i) ? scaled(i) : 0.0; }));
  const std::uint64_t sum = sum_of("pnpbs::Level::mean_speed", nodes_.count, [&](std::int64_t i) {
    return nodes_.owned(i) ? fixed_point(scaled(i)) : 0;
  });
  const auto all = static_cast<std::int64_t>(comm_->sum(static_cast<std::uint64_t>(owned_count())));
  const std::int64_t moving = std::max<std::int64_t>(1, all - boundary_nodes());
  speeds.mean = from_fixed_point(comm_->sum(sum)) / static_cast<double>(moving);
  return speeds;
}

// Lists and stars of the present positions, from which visibility is judged from now on.
void Level::look_around() {
  // The guard of a node asks where its neighbours want to go, which their stars tell.
  constexpr int kRings = 1;
  drop_anchors();
  exchange(kStarHops);
  make_lists_and_stars(kStarHops, settings_.list_radius, kRings);
  looked_around_ = version_;
}

// After the last population event nodes may still be pressed into a corner until they coincide.
// Here nothing is born, so there is no contest: of many in one place all go at once but the first.
// One that only coincides with nodes that may go themselves waits for the next round.
PopulationCounts Level::remove_crowded() {
  PopulationCounts counts;
  while (true) {
    look_around();
    std::vector<std::int32_t> crowded;
    agreed(*comm_, [&] { crowded = crowded_nodes(); });
    const auto own = std::count_if(crowded.begin(), crowded.end(),
                                   [this](std::int32_t i) { return nodes_.owned(i) != 0; });
    if (comm_->sum(static_cast<std::uint64_t>(own)) == 0) return counts;
    counts.deleted += own;
    ++version_;
    delete_nodes(crowded);
  }
}

std::vector<std::int32_t> Level::crowded_nodes() const {
  const PhaseTimer timer(timers_, Phase::population);
  constexpr double kALittleMore = 1.001;  // so that rounding decides nothing here
  const View<char> no_room = make_view<char>("pnpbs::Level::no_room", nodes_.count);
  for_each("pnpbs::Level::no_room", lists_.block_count(), [&](std::int64_t b) {
    const bool look = any_within(nodes_, lists_, kALittleMore * kNearlyCoincide, b);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes_.count); ++i)
      no_room(i) = nodes_.moves(i) && (look ? has_no_room(i) : between_edges(i));
  });
  std::vector<std::int32_t> crowded;
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    if (!no_room(i)) continue;
    bool goes = between_edges(i);
    for_coinciding(i, [&](std::int64_t j) { goes = goes || !no_room(j); });
    if (goes) crowded.push_back(static_cast<std::int32_t>(i));
  }
  return crowded;
}

// In blocks of a few sweeps, within which the stars stay as they are.
void Level::sweep(std::int64_t times) {
  constexpr std::int64_t kBlock = 5;
  for (std::int64_t done = 0; done < times; done += kBlock) {
    if (looked_around_ != version_) look_around();
    ++version_;
    const PhaseTimer timer(timers_, Phase::sweeps);
    View<char> allowed;
    agreed(*comm_, [&] { allowed = make_view<char>("pnpbs::Level::allowed", nodes_.count); });
    for (std::int64_t s = 0; s < std::min(kBlock, times - done); ++s) {
      renew_ghosts();
      pnpbs::sweep(nodes_, stars_, near_edges_, map_, settings_.sweep, next_, allowed);
      ghosts_exact_ = false;
    }
    lists_valid_ = false;
  }
}

}  // namespace pnpbs
