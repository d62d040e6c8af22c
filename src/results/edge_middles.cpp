// SPDX-License-Identifier: BSD-3-Clause
#include "results/edge_middles.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "domain/volume/feature_nodes.hpp"
#include "implicit/level_set.hpp"
#include "results/facet_tag.hpp"

namespace pnpbs {
namespace {

constexpr double kReach = 0.25;  // of a middle to its surface [length of the edge]

using Pair = std::array<std::int32_t, 2>;

Pair ascending(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

// The middles between consecutive nodes of the feature curves.
class FeatureMiddles {
 public:
  explicit FeatureMiddles(const LevelGeometry<3>& geometry) {
    const VolumeDomain& domain = geometry.domain();
    const FeatureNodes& laid = geometry.features();
    FeatureNodes middles = middles_between(domain.mesh(), domain.features(), laid);
    project_to_creases(domain.resolved(), middles, geometry.boundary().node_distance);
    for (std::size_t c = 0; c < middles.along.size(); ++c)
      for (std::size_t k = 0; k < middles.along[c].size(); ++k)
        middles_.emplace_back(
            ascending(laid.along[c][k], laid.along[c][k + 1]),
            middles.nodes[static_cast<std::size_t>(middles.along[c][k])].position);
    std::ranges::stable_sort(middles_, {}, &Middle::first);
  }

  // Returns the middle between two feature nodes, or null if they are not consecutive.
  const Point<3>* between(std::int32_t a, std::int32_t b) const {
    const Pair nodes = ascending(a, b);
    const auto found = std::ranges::lower_bound(middles_, nodes, {}, &Middle::first);
    return found != middles_.end() && found->first == nodes ? &found->second : nullptr;
  }

 private:
  using Middle = std::pair<Pair, Point<3>>;
  std::vector<Middle> middles_;  // ordered by their nodes
};

// Returns the point nearest to x of the triangles of these patches, within `reach`.
NearestPoint<3> nearest_of(const LevelGeometry<3>& geometry,
                           const std::vector<std::int32_t>& patches, const Point<3>& x,
                           double reach) {
  const SurfaceIndex& index = geometry.domain().index();
  const Surface& surface = geometry.surface();
  const auto belongs = [&](std::int32_t facet) {
    return std::ranges::find(patches, surface.patch(facet)) != patches.end();
  };
  NearestPoint<3> nearest = index.nearest(x, reach);
  if (nearest.facet < 0 || belongs(nearest.facet)) return nearest;
  nearest = {reach};
  index.sides().for_facets_near(x, reach, [&](std::int32_t f) {
    if (!belongs(f)) return;
    const Point<3> there = nearest_on(surface.corners(f), x);
    const double gap = distance<3>(there, x);
    if (gap < nearest.gap || (gap == nearest.gap && f < nearest.facet)) nearest = {gap, f, there};
  });
  return nearest;
}

// Returns the boundary edge between two nodes of the plane, or null if there is none.
const BoundaryEdge* boundary_edge_between(const Level<2>& level,
                                          const std::array<std::int64_t, 2>& nodes) {
  const std::int32_t a = level.nodes.boundary_node(nodes[0]);
  const std::int32_t b = level.nodes.boundary_node(nodes[1]);
  if (a < 0 || b < 0) return nullptr;
  const IncidentSectors& sectors = level.geometry.sectors();
  for (std::int32_t k = sectors.begin(a); k < sectors.end(a); ++k)
    if (sectors.edge(k).other == b)
      return &level.geometry.boundary().facets[static_cast<std::size_t>(sectors.edge(k).edge)];
  return nullptr;
}

}  // namespace

void move_to_boundary(const Level<2>& level, std::span<EdgeMiddle<2>> edges) {
  const Boundary& boundary = level.geometry.boundary();
  for (EdgeMiddle<2>& edge : edges)
    if (const BoundaryEdge* const on = boundary_edge_between(level, edge.nodes))
      edge.x = boundary.middles[static_cast<std::size_t>(on - boundary.facets.data())];
}

void move_to_boundary(const Level<3>& level, std::span<EdgeMiddle<3>> edges) {
  const Nodes<3>& nodes = level.nodes;
  const LevelGeometry<3>& geometry = level.geometry;
  const LevelSetTriangles& level_sets = geometry.domain().level_sets();
  const FeatureMiddles features(geometry);
  const auto on_feature = [&](std::int64_t i) {
    return nodes.carrier(i) == Carrier::curve || nodes.carrier(i) == Carrier::fixed;
  };
  const auto is_free = [&](std::int64_t i) { return nodes.carrier(i) == Carrier::free; };
  std::vector<const LevelSet*> set_of(edges.size(), nullptr);
  for_each("pnpbs::move_to_boundary", std::ssize(edges), [&](std::int64_t e) {
    EdgeMiddle<3>& edge = edges[static_cast<std::size_t>(e)];
    const auto& [i, j] = edge.nodes;
    if (is_free(i) || is_free(j)) return;
    if (on_feature(i) && on_feature(j)) {
      const Point<3>* const middle =
          features.between(nodes.boundary_node(i), nodes.boundary_node(j));
      if (middle) {
        edge.x = *middle;
        return;
      }
    }
    const NearestPoint<3> nearest =
        nearest_of(geometry, common_patches(level, edge.nodes), edge.x,
                   kReach * distance<3>(nodes.position(i), nodes.position(j)));
    if (nearest.facet < 0) return;
    edge.x = nearest.x;
    set_of[static_cast<std::size_t>(e)] = level_sets.at(nearest.facet);
  });
  for (const auto& set : level_sets.sets) {
    if (!set) continue;
    std::vector<std::size_t> of_set;
    std::vector<Point<3>> points;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (set_of[e] != set.get()) continue;
      of_set.push_back(e);
      points.push_back(edges[e].x);
    }
    set->project(points, set->resolution());
    for (std::size_t k = 0; k < of_set.size(); ++k) edges[of_set[k]].x = points[k];
  }
}

}  // namespace pnpbs
