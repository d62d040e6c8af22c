// SPDX-License-Identifier: BSD-3-Clause
#include "level/lists_and_stars.hpp"

#include <algorithm>
#include <map>

#include "level/exchange.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

void widen(Box<2>& box, const Box<2>& by) {
  for (int k = 0; k < 2; ++k) {
    box.low[k] = std::min(box.low[k], by.low[k]);
    box.high[k] = std::max(box.high[k], by.high[k]);
  }
}

// Where all nodes are known after an exchange that deep.
KnownRegion<2> known_after_exchange(Level& level, int hops) {
  if (!level.distributed()) return {};
  const LevelTree& tree = *level.tree;
  const Halo& halo = level.tree->halo(hops, level.settings);
  std::vector<char> known(static_cast<std::size_t>(tree.tree().leaf_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.tree().leaf_count(); ++leaf) {
    known[static_cast<std::size_t>(leaf)] = tree.owns(leaf) || tree.map().leaf_outside(leaf);
    if (tree.distribution().refined(leaf))
      halo.for_ranks(leaf, [&](int r) {
        if (r == level.comm->rank()) known[static_cast<std::size_t>(leaf)] = 1;
      });
  }
  return KnownRegion<2>(tree.tree(), known);
}

void build_stars(Level& level, const KnownRegion<2>& known) {
  const PhaseTimer timer(level.timers, Phase::stars);
  const Neighbourhood& neighbourhood = level.neighbourhood;
  level.stars.build({level.nodes, level.map(), level.ground.sectors(), neighbourhood.buckets(),
                     neighbourhood.lists(), neighbourhood.near_edges(), known});
}

// Those not reached yet.
std::vector<std::int64_t> neighbours_of(const DelaunayStars& stars,
                                        const std::vector<std::int64_t>& front,
                                        std::vector<char>& reached) {
  std::vector<std::int64_t> next;
  for (const std::int64_t i : front)
    stars.for_neighbours(i, [&](std::int64_t j) {
      char& known = reached[static_cast<std::size_t>(j)];
      if (!known) next.push_back(j);
      known = 1;
    });
  return next;
}

// What must be known for the stars that are needed: one box for the nodes of each leaf.
std::vector<Box<2>> unknown_around_stars(const Level& level, int rings) {
  const Nodes<2>& nodes = level.nodes;
  const DelaunayStars& stars = level.stars;
  std::map<std::int32_t, Box<2>> box_of;
  const auto ask_around = [&](std::int64_t i) {
    if (stars.needs(i) == 0) return;
    const Box<2> box = box_around<2>(nodes.position(i), stars.needs(i));
    widen(box_of.try_emplace(level.neighbourhood.buckets().bucket_of(i), box).first->second, box);
  };
  std::vector<std::int64_t> front;
  std::vector<char> reached(static_cast<std::size_t>(nodes.count), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    reached[static_cast<std::size_t>(i)] = nodes.owned(i);
    if (!nodes.owned(i)) continue;
    ask_around(i);
    bool at_border = false;
    stars.for_neighbours(i, [&](std::int64_t j) { at_border = at_border || !nodes.owned(j); });
    if (at_border) front.push_back(i);
  }
  for (int ring = 0; ring < rings; ++ring) {
    front = neighbours_of(stars, front, reached);
    for (const std::int64_t i : front) ask_around(i);
  }
  std::vector<Box<2>> boxes;
  for (const auto& [leaf, box] : box_of) boxes.push_back(box);
  return boxes;
}

void sort_nodes(Level& level) {
  if (level.neighbourhood.sort_nodes(level.nodes, *level.tree, level.settings))
    level.ghosts.permute(level.neighbourhood.buckets().order(), level.nodes.count);
}

}  // namespace

void rebuild_lists_for_steps(Level& level) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_for_steps(level.nodes, level.ground, *level.tree, level.settings);
}

void rebuild_lists(Level& level, double radius) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_here(level.nodes, level.ground, *level.tree, radius);
}

void rebuild_stars(Level& level) { build_stars(level, KnownRegion<2>()); }

void make_lists_and_stars(Level& level, int hops, double radius, int rings) {
  agreed(*level.comm, [&] { rebuild_lists(level, radius); });
  make_stars(level, hops, radius, rings);
}

void make_stars(Level& level, int hops, double radius, int rings) {
  KnownRegion<2> known = known_after_exchange(level, hops);
  while (true) {
    std::vector<Box<2>> unknown;
    agreed(*level.comm, [&] {
      build_stars(level, known);
      if (!known.is_everywhere()) unknown = unknown_around_stars(level, rings);
    });
    if (level.comm->allreduce_sum(unknown.size()) == 0) break;
    {
      const PhaseTimer timer(level.timers, Phase::exchange);
      level.ghosts.fetch(*level.comm, *level.tree, unknown, level.nodes,
                         level.neighbourhood.buckets());
    }
    for (const Box<2>& box : unknown) known.add(box);
    agreed(*level.comm, [&] { rebuild_lists(level, radius); });
  }
}

void prepare_lists(Level& level) {
  if (!level.ghosts.are_exact(level.nodes, kStarHops)) exchange(level, kStarHops);
  if (level.distributed())
    make_lists_and_stars(level, kStarHops, level.settings.adjacency_radius, 0);
  else
    rebuild_lists(level, level.settings.adjacency_radius);
}

}  // namespace pnpbs
