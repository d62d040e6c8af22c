// SPDX-License-Identifier: BSD-3-Clause
#include "results/node_normal.hpp"

#include <cstddef>

#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "domain/volume/feature_nodes.hpp"

namespace pnpbs {

namespace {

Point<3> mean_of(const Point<3>& sum) {
  constexpr double kAgainst = 1e-6;  // unit vectors whose sum is shorter cancel each other
  return length(sum) > kAgainst ? unit_vector(sum) : Point<3>{};
}

Point<3> normal_of_facets(const Level<3>& level, std::int64_t i) {
  Point<3> sum{};
  if (level.nodes.carrier(i) == Carrier::free) return sum;
  level.geometry.surface().for_sides(
      level.geometry.place(level.nodes.carrier(i), level.nodes.boundary_node(i)),
      [&](const SurfaceSide& side) { sum = shifted(sum, 1, side.normal); });
  return mean_of(sum);
}

// Returns the gradient, reversed if it points against the normal of the facets: a level set may
// bound a cavity.
Point<3> as_seen(const Point<3>& gradient, const Point<3>& facets) {
  return dot(gradient, facets) < 0 ? shifted({}, -1, gradient) : gradient;
}

// Returns the sum of the area vectors of a facet and its neighbours. The weights make the influence
// of thin facets small.
Point<3> area_around(const Surface& surface, std::int32_t facet) {
  Point<3> sum{};
  const auto add = [&](std::int32_t f) {
    const auto [a, b, c] = surface.corners(f);
    sum = shifted(sum, 1, cross(difference(b, a), difference(c, a)));
  };
  add(facet);
  for (int k = 0; k < 3; ++k)
    if (surface.across(facet, k) >= 0) add(surface.across(facet, k));
  return sum;
}

void take_gradients(const Level<3>& level, std::span<const std::int64_t> nodes,
                    std::vector<Point<3>>& normals) {
  const LevelSetTriangles& sets = level.geometry.domain().level_sets();
  for (const auto& set : sets.sets) {
    if (!set) continue;
    std::vector<std::size_t> on_set;
    std::vector<Point<3>> places;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (level.nodes.carrier(nodes[k]) == Carrier::surface &&
          sets.at(level.nodes.boundary_node(nodes[k])) == set.get()) {
        on_set.push_back(k);
        places.push_back(level.nodes.position(nodes[k]));
      }
    const std::vector<LevelSetSlope> slopes = set->slopes(places);
    for (std::size_t k = 0; k < on_set.size(); ++k) {
      const std::int32_t facet = level.nodes.boundary_node(nodes[on_set[k]]);
      const Point<3> up = slopes[k].normal();
      if (up != Point<3>{})
        normals[on_set[k]] = as_seen(up, area_around(level.geometry.surface(), facet));
    }
  }
}

}  // namespace

std::vector<Point<3>> node_normals(const Level<3>& level, std::span<const std::int64_t> nodes) {
  std::vector<Point<3>> normals;
  for (const std::int64_t i : nodes) normals.push_back(normal_of_facets(level, i));
  take_gradients(level, nodes, normals);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (level.nodes.carrier(nodes[k]) != Carrier::curve) continue;
    const FeatureNode& node =
        level.geometry.features().nodes[index(level.nodes.boundary_node(nodes[k]))];
    const auto [left, right] = normals_beside(level.geometry.domain().resolved(), node);
    if (left != Point<3>{}) normals[k] = as_seen(mean_of(shifted(left, 1, right)), normals[k]);
  }
  return normals;
}

}  // namespace pnpbs
