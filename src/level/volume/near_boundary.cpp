// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/near_boundary.hpp"

#include <algorithm>
#include <atomic>

#include "base/space_vectors.hpp"
#include "domain/volume/surface_walk.hpp"
#include "geometry/clearance.hpp"
#include "method/constants.hpp"
#include "tree/hop_search.hpp"

namespace pnpbs {

// ------------------------------------------------------------------ visibility -----------------

// The flags are atomic because several threads build lists.
bool VisibilityInSpace::visible(std::int64_t i, std::int64_t j) {
  if (in_sight(i, j)) return true;
  for (const std::int64_t node : {i, j})
    std::atomic_ref<char>(hidden_(node)).store(1, std::memory_order_relaxed);
  return false;
}

bool VisibilityInSpace::in_sight(std::int64_t i, std::int64_t j) const {
  const bool i_free = nodes_.carrier(i) == Carrier::free,
             j_free = nodes_.carrier(j) == Carrier::free;
  if (i_free || j_free) return i_free ? looks_at(j, i) : looks_at(i, j);
  if (geometry_.surface().sees(place(i), place(j))) return true;
  return !bubbles_on_surfaces() && see_through_inside(i, j);
}

// Returns whether the inner node lies in front of a surface at the boundary node. Inner nodes are
// so far from the boundary that nothing lies between two that are close enough to repel each other.
bool VisibilityInSpace::looks_at(std::int64_t on_boundary, std::int64_t inner) const {
  const Point<3> way = difference(point_at<3>(at_, inner), point_at<3>(at_, on_boundary));
  bool any = false, in_front = false;
  geometry_.surface().for_sides(place(on_boundary), [&](const SurfaceSide& side) {
    any = true;
    in_front = in_front || !geometry_.patch_bounds_domain(side.patch) || dot(way, side.normal) < 0;
  });
  return in_front || !any;  // a fixed node or an inner curve has no surface
}

// Returns whether the middle between two boundary nodes is inside. It decides the visibility of
// nodes on different surfaces or on two sides of a feature edge.
bool VisibilityInSpace::see_through_inside(std::int64_t i, std::int64_t j) const {
  const Point<3> a = point_at<3>(at_, i), b = point_at<3>(at_, j);
  return geometry_.domain().index().inside(middle_of<3>(a, b));
}

// ------------------------------------------------------------------ near facets ----------------

NearBoundary<3>::NearLeaves NearBoundary<3>::near_leaves(const LevelTree<3>& level_tree,
                                                         double radius) {
  const SizedTree<3>& map = level_tree.map();
  const LeafGraph<3>& links = *level_tree.links();
  const auto leaves = static_cast<std::size_t>(map.tree().leaf_count());
  NearLeaves near{radius, std::vector<double>(leaves), std::vector<char>(leaves)};
  std::vector<std::int32_t> with_facets;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf)
    if (map.leaf_has_facets(leaf)) with_facets.push_back(leaf);
  const std::vector<std::int32_t> to_facets = hops_from(links, with_facets, 1);
  for (std::size_t l = 0; l < leaves; ++l) {
    const auto leaf = static_cast<std::int32_t>(l);
    const double reach = kRoomForGrowth * radius * map.leaf_max_spacing(leaf);
    bool clear = to_facets[l] > 1;
    if (reach > links.reach(leaf)) {
      clear = true;
      const std::int32_t cell = map.tree().leaf_cell(leaf);
      const double half_diagonal = 0.8661 * map.tree().cell_side(cell);
      map.for_facets_near(map.tree().cell_centre(cell), half_diagonal + reach,
                          [&](std::int32_t) { clear = false; });
    }
    near.reach[l] = reach;
    near.clear[l] = clear;
  }
  return near;
}

void NearBoundary<3>::build(const Nodes<3>& nodes, const Field<3>& at, const Buckets<3>& buckets,
                            const SizedTree<3>& map, const LevelGeometry<3>& geometry,
                            ListsOf listed) {
  at_ = at;
  if (static_cast<std::int64_t>(gap_.extent(0)) < nodes.capacity()) {
    gap_ = make_view<double>("pnpbs::NearBoundary::gap", nodes.capacity());
    hidden_ = make_view<char>("pnpbs::NearBoundary::hidden", nodes.capacity());
  }
  for_each("pnpbs::NearBoundary::build", nodes.count, [&](std::int64_t i) {
    hidden_(i) = 0;
    if (!nodes.moves(i))
      gap_(i) = kFarAway;
    else if (listed == ListsOf::owned_nodes && !nodes.owned(i))
      gap_(i) = 0;
    else
      gap_(i) = gap_of(i, nodes, buckets, map, geometry);
  });
}

void NearBoundary<3>::add(const Nodes<3>& nodes, const Buckets<3>& buckets, const SizedTree<3>& map,
                          const LevelGeometry<3>& geometry, const std::vector<std::int32_t>& more) {
  for_each("pnpbs::NearBoundary::add", std::ssize(more), [&](std::int64_t k) {
    const std::int32_t i = more[static_cast<std::size_t>(k)];
    if (nodes.moves(i)) gap_(i) = gap_of(i, nodes, buckets, map, geometry);
  });
}

// Returns the distance of node i from the nearest facet, or a lower bound of it that exceeds d
// where the distance does (a surface node: from the nearest feature edge). Few leaves are near
// facets; for these the index of the domain is searched.
double NearBoundary<3>::gap_of(std::int64_t i, const Nodes<3>& nodes, const Buckets<3>& buckets,
                               const SizedTree<3>& map, const LevelGeometry<3>& geometry) const {
  const double reach = near_.radius * nodes.d(i);
  if (nodes.carrier(i) == Carrier::surface) {
    const SurfacePoint here{nodes.boundary_node(i), nodes.position(i)};
    const double gap = geometry.surface().feature_clearance(here, reach);
    return gap < reach ? gap : kFarAway;
  }
  const Point<3> x = point_at<3>(at_, i);
  const std::int32_t bucket = buckets.bucket_of(i);
  const bool in_bucket = map.tree().fine_box_holds(map.tree().fine_box(bucket), x);
  const std::int32_t leaf = in_bucket ? bucket : map.tree().leaf_at(x);
  if (leaf_is_clear(leaf) && reach <= near_.reach[static_cast<std::size_t>(leaf)]) return kFarAway;
  const double gap = geometry.domain().index().least_clearance(x, nodes.d(i), reach);
  return gap < reach ? gap : kFarAway;
}

// ------------------------------------------------------------------ motion ---------------------

Point<3> NearBoundary<3>::hold_off(std::int64_t i, Nodes<3>& nodes, const SizedTree<3>&,
                                   const LevelGeometry<3>& geometry, const Point<3>& to) const {
  if (nodes.carrier(i) == Carrier::surface) return walk_on_surface(i, nodes, geometry, to);
  constexpr double kRounding = 1 + 1e-8;
  const double clearance = method::kVolumeClearance * nodes.d(i);
  const Point<3> from = nodes.position(i);
  const double way = std::max(clearance, distance<3>(from, to));
  if (gap_(i) > kRounding * (distance<3>(point_at<3>(at_, i), to) + way)) return to;
  const SurfaceIndex& index = geometry.domain().index();
  const NearestPoint<3> nearest = index.nearest(to, clearance);
  // If the step is too short to reach any facet, the node is still inside.
  const double facet_free = nearest.facet < 0 ? clearance : nearest.gap;
  const bool inside = facet_free > kRounding * distance<3>(from, to) || index.inside(to);
  if (inside && nearest.facet < 0) return to;
  if (!inside || nearest.gap == 0) return from;
  const Point<3> kept = shifted(nearest.x, clearance / nearest.gap, difference(to, nearest.x));
  // A wedge or gap may have no point with the full clearance. A larger one than before is accepted.
  return index.inside(kept) && index.clearance(kept, clearance) >= nearest.gap ? kept : from;
}

bool NearBoundary<3>::far_on_the_way(std::int64_t i, const Nodes<3>& nodes, const Point<3>& to,
                                     double clearance) const {
  constexpr double kRounding = 1 + 1e-8;
  return gap_(i) > kRounding * (distance<3>(point_at<3>(at_, i), to) +
                                std::max(clearance, distance<3>(nodes.position(i), to)));
}

bool NearBoundary<3>::stays_clear_of_inner(std::int64_t i, const Nodes<3>& nodes,
                                           const LevelGeometry<3>& geometry, const Point<3>& to,
                                           double clearance) const {
  if (far_on_the_way(i, nodes, to, clearance)) return true;
  const SurfaceIndex& index = geometry.domain().index();
  const NearestPoint<3> there = index.nearest(to, clearance);
  return there.facet < 0 || !geometry.on_inner_surface(there.facet) ||
         there.gap >= index.clearance(nodes.position(i), clearance);
}

bool NearBoundary<3>::stays_clear(std::int64_t i, const Nodes<3>& nodes,
                                  const LevelGeometry<3>& geometry, const Point<3>& to,
                                  double clearance) const {
  if (far_on_the_way(i, nodes, to, clearance)) return true;
  const SurfaceIndex& index = geometry.domain().index();
  if (!index.inside(to)) return false;
  const double gap = index.clearance(to, clearance);
  return gap >= clearance || gap >= index.clearance(nodes.position(i), clearance);
}

// Moves a surface node along its surface. It may come closer to a feature than its clearance only
// if it was closer before.
Point<3> NearBoundary<3>::walk_on_surface(std::int64_t i, Nodes<3>& nodes,
                                          const LevelGeometry<3>& geometry,
                                          const Point<3>& to) const {
  const Surface& surface = geometry.surface();
  const SurfacePoint from{nodes.boundary_node(i), nodes.position(i)};
  const SurfacePoint reached = walk(surface, from, difference(to, from.position));
  const double clearance = method::kBoundaryClearance * nodes.d(i);
  const double gap = surface.feature_clearance(reached, clearance);
  if (gap < clearance && gap < surface.feature_clearance(from, clearance)) return from.position;
  nodes.boundary_node(i) = reached.facet;
  return reached.position;
}

}  // namespace pnpbs
