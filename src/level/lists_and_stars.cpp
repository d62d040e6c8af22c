// SPDX-License-Identifier: BSD-3-Clause
#include "level/lists_and_stars.hpp"

#include <set>

#include "delaunay/volume/agreed_triangles.hpp"
#include "level/exchange.hpp"
#include "level/finding_stars.hpp"
#include "level/ghost_lists.hpp"
#include "level/known_after_exchange.hpp"
#include "level/plane/closed_sphere.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

// Calls visit(leaf, number of owned nodes) for the leaves with owned nodes.
template <int Dim, class Visit>
void for_leaves_with_own(const Level<Dim>& level, const Visit& visit) {
  const Buckets<Dim>& buckets = level.neighbourhood.buckets();
  for (std::int32_t leaf = 0; leaf < level.tree->tree().leaf_count(); ++leaf) {
    const std::int32_t begin = buckets.begin(leaf), end = buckets.end(leaf);
    std::int64_t owned = 0;
    for (std::int32_t i = begin; i < end; ++i) owned += level.nodes.owned(i);
    if (owned > 0) visit(leaf, owned);
  }
}

template <int Dim>
Box<Dim> box_of_lists(const Level<Dim>& level, double radius, std::int32_t leaf) {
  const BackgroundTree<Dim>& tree = level.tree->tree();
  return widened(tree.cell_box(tree.leaf_cell(leaf)), radius * level.map().leaf_max_spacing(leaf));
}

// Calls visit(leaf) for the unknown leaves that are linked with `leaf`, for a whole sphere. The box
// of lists may cover the whole chart there, whereas leaves are linked by their reach along the
// sphere.
template <int Dim, class Visit>
void for_unknown_linked(const Level<Dim>& level, const KnownRegion<Dim>& known, std::int32_t leaf,
                        const Visit& visit) {
  level.neighbourhood.buckets().for_neighbours(leaf, [&](std::int32_t other) {
    if (known.unknown_in(level.tree->tree().leaf_cell(other))) visit(other);
  });
}

// Returns the boxes that lists reach into and that the exchange does not cover, which happens where
// d is very steep.
template <int Dim>
std::vector<Box<Dim>> unknown_to_lists(const Level<Dim>& level, const KnownRegion<Dim>& known,
                                       double radius) {
  std::vector<Box<Dim>> unknown;
  if (!level.distributed()) return unknown;
  const BackgroundTree<Dim>& tree = level.tree->tree();
  std::set<std::int32_t> leaves;
  for_leaves_with_own(level, [&](std::int32_t leaf, std::int64_t) {
    if (is_closed_sphere(level))
      return for_unknown_linked(level, known, leaf, [&](std::int32_t l) { leaves.insert(l); });
    const Box<Dim> reached = box_of_lists(level, radius, leaf);
    if (!known.covers(tree, reached)) unknown.push_back(reached);
  });
  for (const std::int32_t leaf : leaves) unknown.push_back(tree.cell_box(tree.leaf_cell(leaf)));
  return unknown;
}

template <int Dim>
bool lists_know_all(const Level<Dim>& level, const KnownRegion<Dim>& known, double radius,
                    std::int32_t leaf) {
  if (!is_closed_sphere(level))
    return known.covers(level.tree->tree(), box_of_lists(level, radius, leaf));
  bool all = true;
  for_unknown_linked(level, known, leaf, [&](std::int32_t) { all = false; });
  return all;
}

// Returns the number of owned nodes whose lists may miss a node, or whose leaf has no owner. If it
// is not 0, results may depend on the number of ranks.
template <int Dim>
std::int64_t lists_beyond_known(const Level<Dim>& level, const KnownRegion<Dim>& known,
                                double radius) {
  if (!level.distributed()) return 0;
  std::int64_t found = 0;
  for_leaves_with_own(level, [&](std::int32_t leaf, std::int64_t owned) {
    if (level.tree->distribution().holder(leaf) < 0 || !lists_know_all(level, known, radius, leaf))
      found += owned;
  });
  return found;
}

// Fetches all nodes in these boxes as ghosts and rebuilds the lists. All ranks must call it, and if
// one rank throws, all ranks throw.
template <int Dim>
void make_known(Level<Dim>& level, const std::vector<Box<Dim>>& boxes, double radius,
                KnownRegion<Dim>& known) {
  {
    const PhaseTimer timer(level.timers, Phase::exchange);
    level.ghosts.fetch(*level.comm, *level.tree, boxes, level.nodes, level.neighbourhood.buckets());
  }
  for (const Box<Dim>& box : boxes) known.add(level.tree->tree(), box);
  collective_try(*level.comm, [&] { rebuild_lists(level, radius, lists_of_stars(level)); });
}

}  // namespace

// The ghosts must follow the new order of the nodes even if the sort fails after changing it.
template <int Dim>
void sort_nodes(Level<Dim>& level) {
  if (!level.neighbourhood.is_for(*level.tree))
    level.neighbourhood.adopt(
        *level.tree, NearBoundary<Dim>::near_leaves(*level.tree, edge_radius(level.settings)));
  level.ghosts.reserve_order(level.nodes.count);
  const std::int64_t before = level.nodes.arrangement();
  const std::exception_ptr failure =
      failure_of([&] { level.neighbourhood.sort_nodes(level.nodes, *level.tree, level.settings); });
  if (level.nodes.arrangement() != before)
    level.ghosts.permute(level.neighbourhood.buckets().order(), level.nodes.count);
  if (failure) std::rethrow_exception(failure);
}

template <int Dim>
void rebuild_lists_for_steps(Level<Dim>& level, ListsOf listed) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_for_steps(level.nodes, level.geometry, *level.tree, level.settings,
                                        listed);
  level.timers.add(Phase::lists, level.neighbourhood.nodes_listed());
}

template <int Dim>
void rebuild_lists(Level<Dim>& level, double radius, ListsOf listed) {
  const PhaseTimer timer(level.timers, Phase::lists);
  sort_nodes(level);
  level.neighbourhood.rebuild_here(level.nodes, level.geometry, *level.tree, radius, listed);
  level.timers.add(Phase::lists, level.neighbourhood.nodes_listed());
}

template <int Dim>
void make_lists_and_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone) {
  collective_try(*level.comm, [&] { rebuild_lists(level, radius, lists_of_stars(level)); });
  make_stars(level, hops, radius, zone);
}

template <int Dim>
void make_stars(Level<Dim>& level, int hops, double radius, GhostStarDepth zone) {
  if (level.geometry.kind() == GeometryKind::surface) zone.rings += AgreedTriangles::kRings;
  level.changed_labels = {};
  KnownRegion<Dim> known = known_after_exchange(level, hops);
  const auto any = [&](const std::vector<Box<Dim>>& unknown) {
    return level.comm->allreduce_sum(unknown.size()) > 0;
  };
  bool stored_stars_hold = stars_hold(level);
  std::vector<Box<Dim>> unknown = unknown_to_lists(level, known, radius);
  if (any(unknown)) make_known(level, unknown, radius, known);
  while (any(unknown = find_stars(level, known, zone, stored_stars_hold))) {
    stored_stars_hold = keep_found_stars(level);
    make_known(level, unknown, radius, known);
  }
  level.stars_before.forget();
  level.unknown_uses += lists_beyond_known(level, known, radius);
}

// Stars with changed labels are not a function of the nodes alone, so they get no digest.
template <int Dim>
void take_stars(Level<Dim>& level) {
  collective_try(*level.comm, [&] {
    level.stars_before.take(level.nodes, level.stars,
                            level.changed_labels.any() ? 0 : level.stars_digest);
  });
  level.stars_digest = 0;
}

template <int Dim>
void make_known_around(Level<Dim>& level, double radius) {
  if (!level.distributed()) return;
  KnownRegion<Dim> known = known_after_exchange(level, kStarHops);
  const std::vector<Box<Dim>> unknown = unknown_to_lists(level, known, radius);
  if (level.comm->allreduce_sum(unknown.size()) > 0)
    make_known(level, unknown, level.settings.adjacency_radius, known);
}

template <int Dim>
void prepare_lists(Level<Dim>& level) {
  take_stars(level);
  if (!level.ghosts.are_exact(level.nodes, kStarHops)) exchange(level, kStarHops);
  if (level.distributed())
    make_lists_and_stars(level, kStarHops, level.settings.adjacency_radius, {});
  else
    rebuild_lists(level, level.settings.adjacency_radius);
}

template void sort_nodes(Level<2>&);
template void sort_nodes(Level<3>&);
template void rebuild_lists_for_steps(Level<2>&, ListsOf);
template void rebuild_lists_for_steps(Level<3>&, ListsOf);
template void rebuild_lists(Level<2>&, double, ListsOf);
template void rebuild_lists(Level<3>&, double, ListsOf);
template void make_lists_and_stars(Level<2>&, int, double, GhostStarDepth);
template void make_lists_and_stars(Level<3>&, int, double, GhostStarDepth);
template void make_stars(Level<2>&, int, double, GhostStarDepth);
template void make_stars(Level<3>&, int, double, GhostStarDepth);
template void take_stars(Level<2>&);
template void take_stars(Level<3>&);
template void make_known_around(Level<2>&, double);
template void make_known_around(Level<3>&, double);
template void prepare_lists(Level<2>&);
template void prepare_lists(Level<3>&);

}  // namespace pnpbs
