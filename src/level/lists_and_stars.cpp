// SPDX-License-Identifier: BSD-3-Clause
#include "level/lists_and_stars.hpp"

#include <algorithm>
#include <map>

#include "delaunay/volume/agreed_triangles.hpp"
#include "level/exchange.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

template <int Dim>
void widen(Box<Dim>& box, const Box<Dim>& by) {
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(box.low[k], by.low[k]);
    box.high[k] = std::max(box.high[k], by.high[k]);
  }
}

// Where all nodes are known after an exchange that deep.
template <int Dim>
KnownRegion<Dim> known_after_exchange(Level<Dim>& level, int hops) {
  if (!level.distributed()) return {};
  const LevelTree<Dim>& tree = *level.tree;
  const Halo& halo = level.tree->halo(hops, level.settings);
  std::vector<char> known(static_cast<std::size_t>(tree.tree().leaf_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.tree().leaf_count(); ++leaf) {
    known[static_cast<std::size_t>(leaf)] = tree.owns(leaf) || tree.map().leaf_outside(leaf);
    if (tree.distribution().refined(leaf))
      halo.for_ranks(leaf, [&](int r) {
        if (r == level.comm->rank()) known[static_cast<std::size_t>(leaf)] = 1;
      });
  }
  return KnownRegion<Dim>(tree.tree(), known);
}

StarInput star_input(const Level<2>& level, const KnownRegion<2>& known) {
  const Neighbourhood<2>& neighbourhood = level.neighbourhood;
  return {level.nodes,
          level.map(),
          level.ground.sectors(),
          neighbourhood.buckets(),
          neighbourhood.lists(),
          neighbourhood.near_boundary().edges(),
          known};
}

}  // namespace

VolumeStarInput star_input(const Level<3>& level, const KnownRegion<3>& known) {
  const Neighbourhood<3>& neighbourhood = level.neighbourhood;
  const auto complete = [&level](std::int64_t i) {
    return level.neighbourhood.near_boundary().sees_all(i);
  };
  const auto room = [&level](std::int64_t i) {
    const bool measured = level.nodes.moving == Carrier::free;
    return measured ? level.neighbourhood.near_boundary().room(i, level.nodes) : 0;
  };
  const auto on_one_surface = [&level](const std::array<std::int64_t, 4>& corners) {
    const auto place = [&](std::int64_t i) {
      return level.ground.place(level.nodes.carrier(i), level.nodes.boundary_node(i));
    };
    const Surface& surface = level.ground.surface();
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (!surface.sees(place(corners[a]), place(corners[b]))) return false;
    return true;
  };
  return {level.nodes,
          level.tree->tree(),
          neighbourhood.buckets(),
          neighbourhood.lists(),
          known,
          &level.ground.domain().index().sides(),
          complete,
          room,
          on_one_surface};
}

namespace {

SurfaceStarInput surface_star_input(const Level<3>& level, const KnownRegion<3>& known) {
  return {level.nodes,
          level.tree->tree(),
          level.neighbourhood.buckets(),
          known,
          level.ground.surface(),
          level.ground.features(),
          [&level](std::int64_t i) {
            return level.ground.place(level.nodes.carrier(i), level.nodes.boundary_node(i));
          }};
}

template <int Dim>
void build_stars(Level<Dim>& level, const KnownRegion<Dim>& known) {
  const PhaseTimer timer(level.timers, Phase::stars);
  if constexpr (Dim == 3)
    if (level.ground.surfaces_alone()) return level.stars.build(surface_star_input(level, known));
  level.stars.build(star_input(level, known));
}

// Those not reached yet.
template <class Graph>
std::vector<std::int64_t> neighbours_of(const Graph& stars, const std::vector<std::int64_t>& front,
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
template <int Dim>
std::vector<Box<Dim>> unknown_around_stars(const Level<Dim>& level, int rings) {
  const Nodes<Dim>& nodes = level.nodes;
  const Stars<Dim>& stars = level.stars;
  std::map<std::int32_t, Box<Dim>> box_of;
  const auto ask_around = [&](std::int64_t i) {
    if (stars.needs(i) == 0) return;
    const Box<Dim> box = box_around<Dim>(nodes.position(i), stars.needs(i));
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
  std::vector<Box<Dim>> boxes;
  for (const auto& [leaf, box] : box_of) boxes.push_back(box);
  return boxes;
}

template <int Dim>
void sort_nodes(Level<Dim>& level) {
  if (level.neighbourhood.sort_nodes(level.nodes, *level.tree, level.settings))
    level.ghosts.permute(level.neighbourhood.buckets().order(), level.nodes.count);
}

}  // namespace

template <int Dim>
void rebuild_lists_for_steps(Level<Dim>& level) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_for_steps(level.nodes, level.ground, *level.tree, level.settings);
}

template <int Dim>
void rebuild_lists(Level<Dim>& level, double radius) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_here(level.nodes, level.ground, *level.tree, radius);
}

template <int Dim>
void rebuild_stars(Level<Dim>& level) {
  build_stars(level, KnownRegion<Dim>());
}

template <int Dim>
void make_lists_and_stars(Level<Dim>& level, int hops, double radius, int rings) {
  agreed(*level.comm, [&] { rebuild_lists(level, radius); });
  make_stars(level, hops, radius, rings);
}

template <int Dim>
void make_stars(Level<Dim>& level, int hops, double radius, int rings) {
  if (level.ground.surfaces_alone()) rings += AgreedTriangles::kRings;
  KnownRegion<Dim> known = known_after_exchange(level, hops);
  while (true) {
    std::vector<Box<Dim>> unknown;
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
    for (const Box<Dim>& box : unknown) known.add(box);
    agreed(*level.comm, [&] { rebuild_lists(level, radius); });
  }
}

template <int Dim>
void prepare_lists(Level<Dim>& level) {
  if (!level.ghosts.are_exact(level.nodes, kStarHops<Dim>)) exchange(level, kStarHops<Dim>);
  if (level.distributed())
    make_lists_and_stars(level, kStarHops<Dim>, level.settings.adjacency_radius, 0);
  else
    rebuild_lists(level, level.settings.adjacency_radius);
}

template void rebuild_lists_for_steps(Level<2>&);
template void rebuild_lists_for_steps(Level<3>&);
template void rebuild_lists(Level<2>&, double);
template void rebuild_lists(Level<3>&, double);
template void rebuild_stars(Level<2>&);
template void rebuild_stars(Level<3>&);
template void make_lists_and_stars(Level<2>&, int, double, int);
template void make_lists_and_stars(Level<3>&, int, double, int);
template void make_stars(Level<2>&, int, double, int);
template void make_stars(Level<3>&, int, double, int);
template void prepare_lists(Level<2>&);
template void prepare_lists(Level<3>&);

}  // namespace pnpbs
