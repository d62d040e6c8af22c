// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/surface_stars.hpp"

namespace pnpbs {

bool joined(const LevelGeometry<3>& geometry, const Nodes<3>& nodes, std::int64_t i,
            std::int64_t j) {
  const auto on_feature = [&](std::int64_t k) {
    return nodes.carrier(k) == Carrier::curve || nodes.carrier(k) == Carrier::fixed;
  };
  if (!on_feature(i) || !on_feature(j)) return false;
  return geometry.features().joined(nodes.boundary_node(i), nodes.boundary_node(j));
}

namespace {

constexpr std::int32_t kNowhere = -1, kNotListed = -2;

// Returns the neighbour of feature node i in this direction of a curve.
std::int32_t neighbour_along(const Level<3>& level, std::int64_t i, const CurveDirection& way) {
  if (way.curve < 0) return kNowhere;
  const Nodes<3>& nodes = level.nodes;
  const std::int32_t laid = level.geometry.features().next(nodes.boundary_node(i), way);
  std::int32_t found = kNotListed;
  level.lists().for_neighbours(i, [&](std::int64_t j) {
    const bool on_feature =
        nodes.carrier(j) == Carrier::curve || nodes.carrier(j) == Carrier::fixed;
    if (on_feature && nodes.boundary_node(j) == laid) found = static_cast<std::int32_t>(j);
  });
  return found;
}

StarSide seen_on(const Level<3>& level, std::int64_t i, const SurfaceSide& side) {
  const Nodes<3>& nodes = level.nodes;
  StarSide seen{
      side.normal, neighbour_along(level, i, side.begin), neighbour_along(level, i, side.end), {}};
  level.lists().for_neighbours(i, [&](std::int64_t j) {
    if (nodes.carrier(j) != Carrier::free)
      seen.around.push_back({nodes.position(j), nodes.id(j), static_cast<std::int32_t>(j)});
  });
  return seen;
}

}  // namespace

std::vector<SurfaceStarEntry> surface_star(const Level<3>& level, std::int64_t i) {
  const Nodes<3>& nodes = level.nodes;
  const LevelGeometry<3>& geometry = level.geometry;
  std::vector<StarSide> sides;
  bool known = true;
  geometry.surface().for_sides(geometry.place(nodes, i), [&](const SurfaceSide& side) {
    sides.push_back(seen_on(level, i, side));
    known = known && sides.back().first != kNotListed && sides.back().last != kNotListed;
  });
  std::vector<SurfaceStarEntry> star;
  const Joined on_curve = [&](std::int32_t a, std::int32_t b) {
    return joined(geometry, nodes, a, b);
  };
  const double reach = level.lists().radius() * nodes.d(i);
  const SurfaceStarPoint centre{nodes.position(i), nodes.id(i), static_cast<std::int32_t>(i)};
  if (!known || !tangent_star(centre, 2 * reach, sides, on_curve, star)) star.clear();
  return star;
}

}  // namespace pnpbs
