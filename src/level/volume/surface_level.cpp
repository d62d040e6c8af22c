// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/surface_level.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/space_vectors.hpp"
#include "domain/volume/surface_walk.hpp"
#include "geometry/clearance.hpp"
#include "initial/volume/surface_fill.hpp"
#include "level/exchange.hpp"
#include "level/kept_node.hpp"
#include "level/lists_and_stars.hpp"
#include "level/numbering.hpp"
#include "level/reach.hpp"
#include "level/thinning.hpp"
#include "level/volume/added_nodes.hpp"
#include "level/volume/gaps.hpp"
#include "level/volume/surface_stars.hpp"
#include "method/constants.hpp"
#include "population/free_place.hpp"

namespace pnpbs {

Settings surface_settings(const Settings& inside) {
  Settings settings(Options{}, 2);
  settings.max_nodes = inside.max_nodes;
  settings.max_bytes = inside.max_bytes;
  settings.exchange_interval = inside.exchange_interval;
  settings.metis_seed = inside.metis_seed;
  settings.rebalance_above = inside.rebalance_above;
  settings.growth_limit = inside.growth_limit;  // the tree must not change when it is repartitioned
  return settings;
}

// ------------------------------------------------------------------ storage --------------------

namespace {

IncomingNodes<3> own_feature_nodes(const Level<3>& level) {
  IncomingNodes<3> nodes = level.geometry.feature_nodes();
  std::erase_if(nodes, [&](const IncomingNode<3>& node) {
    return !level.tree->owns(level.tree->tree().leaf_at(node.position));
  });
  return nodes;
}

// Returns this rank's part of a fill of all surfaces. All ranks must call it, and if one rank
// throws, all ranks throw.
IncomingNodes<3> filled_surfaces(const Level<3>& level) {
  const LevelGeometry<3>& geometry = level.geometry;
  const Distribution<3>& distribution = level.tree->distribution();
  const PartitionCells<3> one_cell(geometry.bounds(), {});
  const RankCells cells{
      level.distributed() ? distribution.cells().tree() : one_cell.tree(), [&](std::int32_t cell) {
        return !level.distributed() || distribution.owner_of_cell(cell) == level.comm->rank();
      }};
  IncomingNodes<3> filled;
  for (const SurfacePoint& at : surface_fill(*level.comm, geometry.surface(), geometry.evaluator(),
                                             level.settings.node_limit(), cells))
    filled.push_back(new_surface_node(geometry, at));
  return filled;
}

void append(IncomingNodes<3>& to, const IncomingNodes<3>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void keep_ids_in_place(IncomingNodes<3>& laid, const IncomingNodes<3>& before) {
  std::map<Point<3>, std::int64_t> id_at;
  for (const IncomingNode<3>& node : before) id_at[node.position] = node.id;
  for (IncomingNode<3>& node : laid) {
    const auto found = id_at.find(node.position);
    if (found != id_at.end()) node.id = found->second;
  }
}

}  // namespace

std::int64_t put_surface_nodes(Level<3>& level, IncomingNodes<3> on_surfaces,
                               const IncomingNodes<3>& on_features, bool begin_anew) {
  IncomingNodes<3> laid, filled;
  const auto given = std::ssize(on_surfaces);
  if (!begin_anew) thin_on_surfaces(level, on_surfaces);
  const std::int64_t thinned = given - std::ssize(on_surfaces);
  collective_try(*level.comm, [&] {
    laid = own_feature_nodes(level);
    keep_ids_in_place(laid, on_features);
    filled = filled_surfaces(level);
    append(laid, begin_anew ? filled : on_surfaces);
  });
  level.nodes.moving = Carrier::surface;
  number_and_store(level, {}, BoundaryNodes<3>(std::move(laid)));
  if (begin_anew) return thinned;
  add_nodes(level, in_gaps(level, filled));
  return thinned;
}

IncomingNode<3> new_surface_node(const LevelGeometry<3>& geometry, const SurfacePoint& at,
                                 double d) {
  return {at.position,
          -1,
          Carrier::surface,
          at.facet,
          geometry.boundary().facets[static_cast<std::size_t>(at.facet)].tag,
          -1,
          d};
}

void fix_surface_nodes(Level<3>& level) {
  level.nodes.moving = Carrier::free;
  for_each("pnpbs::fix_surface_nodes", level.nodes.count, [&](std::int64_t i) {
    for (int k = 0; k < 3; ++k) level.nodes.v[k](i) = 0;
  });
}

IncomingNodes<3> surface_nodes(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  IncomingNodes<3> found;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i) && nodes.carrier(i) != Carrier::free) found.push_back(kept_node(nodes, i));
  return found;
}

void put_on_level_sets(const LevelGeometry<3>& geometry, IncomingNodes<3>& nodes) {
  const LevelSetTriangles& triangles = geometry.domain().level_sets();
  for (const std::shared_ptr<const LevelSet>& set : triangles.sets) {
    if (!set) continue;
    std::vector<std::size_t> on_set;
    std::vector<Point<3>> x;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].carrier == Carrier::surface &&
          triangles.at(nodes[i].boundary_node) == set.get()) {
        on_set.push_back(i);
        x.push_back(nodes[i].position);
      }
    set->project(x, geometry.boundary().node_distance);
    for (std::size_t k = 0; k < on_set.size(); ++k) nodes[on_set[k]].position = x[k];
  }
}

void put_on_level_sets(Level<3>& level) {
  if (level.geometry.domain().level_sets().sets.empty()) return;
  Nodes<3>& nodes = level.nodes;
  collective_try(*level.comm, [&] {
    IncomingNodes<3> put = surface_nodes(level);
    put_on_level_sets(level.geometry, put);
    std::size_t next = 0;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (nodes.owned(i) && nodes.carrier(i) != Carrier::free)
        nodes.set_position(i, put[next++].position);
  });
  nodes.moved();
  nodes.set_reference_positions();
  level.ghosts.invalidate();
}

// ------------------------------------------------------------------ walks ----------------------

namespace {

SurfacePoint place_on_surface(const Nodes<3>& nodes, std::int64_t i) {
  return {nodes.boundary_node(i), nodes.position(i)};
}

// Returns the point reached from node i, which is on a surface, by this move.
SurfacePoint walk_from(const Level<3>& level, std::int64_t i, const Point<3>& move) {
  return walk(level.geometry.surface(), place_on_surface(level.nodes, i), move);
}

const Point<3>& normal_at(const Level<3>& level, std::int64_t i) {
  return level.geometry.surface().normal(level.nodes.boundary_node(i));
}

}  // namespace

// ------------------------------------------------------------------ new bubbles ----------------

// Projects the neighbours into the tangent plane, at their true distances, and finds the free
// position there.
Point<3> free_place_on_surface(const Level<3>& level, std::int64_t i) {
  const Nodes<3>& nodes = level.nodes;
  const Point<3>& normal = normal_at(level, i);
  const Point<3> axis = std::fabs(normal[0]) < 0.6 ? Point<3>{1, 0, 0} : Point<3>{0, 1, 0};
  const Point<3> u = unit_vector(part_across(axis, normal)), v = cross(normal, u);
  std::vector<Point<2>> around;
  level.lists().for_neighbours(i, [&](std::int64_t j) {
    const Point<3> way = difference(nodes.position(j), nodes.position(i));
    const Point<2> flat{dot(way, u), dot(way, v)};
    const double seen = std::hypot(flat[0], flat[1]);
    const double stretch = seen > 0 ? length(way) / seen : 0;
    around.push_back({stretch * flat[0], stretch * flat[1]});
  });
  const Point<2> place = free_place<2>({0, 0}, nodes.d(i), around);
  return walk_from(level, i, shifted(shifted({}, place[0], u), place[1], v)).position;
}

// Returns the facet by walking along the chord. Near a node this reaches the same point as the
// original walk, up to the curvature of the surface.
std::int32_t facet_at(const Level<3>& level, std::int64_t from, const Point<3>& place) {
  return pull_back(level.geometry.surface(), place, level.nodes.boundary_node(from)).facet;
}

// ------------------------------------------------------------------ sweeps ---------------------

namespace {

// Returns the point reached by the move, or the present one if the move comes too close to a
// feature and closer than now.
SurfacePoint walk_clear_of_features(const Level<3>& level, std::int64_t i, const Point<3>& move) {
  const SurfacePoint here = place_on_surface(level.nodes, i), to = walk_from(level, i, move);
  const double clearance = method::kBoundaryClearance * level.nodes.d(i);
  const Surface& surface = level.geometry.surface();
  const double gap = surface.feature_clearance(to, clearance);
  return gap < clearance && gap < surface.feature_clearance(here, clearance) ? here : to;
}

// Returns the position of node i after a move towards the mean of its neighbours.
SurfacePoint swept(const Level<3>& level, std::int64_t i, double weight) {
  const Nodes<3>& nodes = level.nodes;
  const SurfacePoint here = place_on_surface(nodes, i);
  const std::vector<SurfaceStarEntry> star = surface_star(level, i);
  if (star.size() < 3) return here;
  Point<3> sum{};
  for (const SurfaceStarEntry& entry : star)
    sum = shifted(sum, 1, difference(nodes.position(entry.node), here.position));
  const double part = weight / static_cast<double>(star.size());
  return walk_clear_of_features(level, i, {part * sum[0], part * sum[1], part * sum[2]});
}

}  // namespace

SurfacePoint go_along_surface(const Level<3>& level, std::int64_t i, const Point<3>& direction,
                              double length) {
  const Point<3> tangent = unit_vector(part_across(direction, normal_at(level, i)));
  return walk_clear_of_features(level, i, shifted({}, length, tangent));
}

void sweep_on_surfaces(Level<3>& level, std::int64_t sweeps) {
  Nodes<3>& nodes = level.nodes;
  for (std::int64_t s = 0; s < sweeps; ++s) {
    nodes.set_reference_positions();
    exchange(level, kStarHops);
    collective_try(*level.comm, [&] {
      rebuild_lists(level, level.settings.list_radius);
      std::vector<SurfacePoint> to(static_cast<std::size_t>(nodes.count));
      const auto moves = [&](std::int64_t i) { return nodes.moves(i) && nodes.owned(i) != 0; };
      for_each("pnpbs::sweep_on_surfaces", nodes.count, [&](std::int64_t i) {
        if (moves(i))
          to[static_cast<std::size_t>(i)] = swept(level, i, level.settings.sweep.weight);
      });
      for_each("pnpbs::sweep_on_surfaces", nodes.count, [&](std::int64_t i) {
        if (!moves(i)) return;
        nodes.set_position(i, to[static_cast<std::size_t>(i)].position);
        nodes.boundary_node(i) = to[static_cast<std::size_t>(i)].facet;
      });
    });
    nodes.moved();
  }
  nodes.set_reference_positions();
  level.ghosts.invalidate();
}

// ------------------------------------------------------------------ refinement -----------------

namespace {

// Returns a new node in the middle between surface node i and a neighbour on its surface.
IncomingNode<3> middle(const Level<3>& level, std::int64_t i, std::int64_t j, double d) {
  const Point<3> way = difference(level.nodes.position(j), level.nodes.position(i));
  const SurfacePoint at = walk_from(level, i, {0.5 * way[0], 0.5 * way[1], 0.5 * way[2]});
  return new_surface_node(level.geometry, at, d);
}

}  // namespace

void append_surface_midpoints(const Level<3>& level, const View<double>& next_spacing,
                              IncomingNodes<3>& refined) {
  const Nodes<3>& nodes = level.nodes;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i) || nodes.carrier(i) != Carrier::surface) continue;
    if (nodes.d(i) < method::kHalvedOnSurfaces * next_spacing(i)) continue;
    const double d = placed_for<2>(nodes.d(i), next_spacing(i), 3);
    const std::vector<SurfaceStarEntry> star = surface_star(level, i);
    for (std::size_t k = 0; k < star.size(); ++k) {
      const std::int64_t j = star[k].node, next = star[(k + 1) % star.size()].node;
      // An edge between two surface nodes belongs to the one with the smaller id.
      if (nodes.carrier(j) != Carrier::surface || nodes.id(i) < nodes.id(j))
        refined.push_back(middle(level, i, j, d));
      if (!star[k].triangle || joined(level.geometry, nodes, j, next)) continue;
      if (nodes.carrier(j) == Carrier::surface || nodes.carrier(next) == Carrier::surface) continue;
      // The middle of an edge between two feature nodes is reached through this triangle.
      const Point<3> a = nodes.position(j), b = nodes.position(next);
      const SurfacePoint at =
          pull_back(level.geometry.surface(), middle_of<3>(a, b), nodes.boundary_node(i));
      refined.push_back(new_surface_node(level.geometry, at, d));
    }
  }
}

}  // namespace pnpbs
