// SPDX-License-Identifier: BSD-3-Clause
#include "results/element_angles.hpp"

#include <algorithm>
#include <array>

#include "level/volume/opposite_nodes.hpp"
#include "quality/volume/small_angles.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "results/own_elements.hpp"
#include "shape/sharp_edges.hpp"

namespace pnpbs {

namespace {

// By memory index, ghosts too, which may be corners: is the node less than d from a sharp edge?
std::vector<char> nodes_at_sharp_edges(const Level<3>& level, const SharpEdges& edges) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<char> at_edge(static_cast<std::size_t>(nodes.count));
  if (!edges.none())
    for_each("pnpbs::nodes_at_sharp_edges", nodes.count, [&](std::int64_t i) {
      at_edge[static_cast<std::size_t>(i)] = edges.any_nearer(nodes.position(i), nodes.d(i));
    });
  return at_edge;
}

SharpEdges sharp_edges(const Level<3>& level) {
  return {level.ground.boundary(), level.ground.surface().features()};
}

bool any_of(const std::vector<char>& nodes, const std::array<std::int64_t, 4>& corners) {
  return std::ranges::any_of(
      corners, [&](std::int64_t c) { return nodes[static_cast<std::size_t>(c)] != 0; });
}

std::array<Point<3>, 4> positions(const Tetrahedron& t) { return {t[0].x, t[1].x, t[2].x, t[3].x}; }

}  // namespace

LeastAngles least_angles(const Level<3>& level, double of_all) {
  const SharpEdges edges = sharp_edges(level);
  if (edges.none()) return {180, of_all};
  LeastAngles least;
  agreed(*level.comm, [&] {
    const std::vector<char> at_edge = nodes_at_sharp_edges(level, edges);
    least = sums_over(
        "pnpbs::least_angles", level.nodes.count, LeastAngles(),
        [&](std::int64_t i, LeastAngles& angles) {
          for_own_elements_at(
              level, i, [&](const Tetrahedron& t, const std::array<std::int64_t, 4>& corners) {
                angles.add(min_dihedral_angle(positions(t)), any_of(at_edge, corners));
              });
        });
  });
  return {-level.comm->allreduce_max(-least.at_sharp_edges),
          -level.comm->allreduce_max(-least.elsewhere)};
}

namespace {

double least_spacing(const Tetrahedron& t) {
  return std::ranges::min_element(t, {}, &VolumeNode::d)->d;
}

}  // namespace

SmallAngleElements small_angle_elements(const Level<3>& level, double below) {
  const SmallAngles small(below);
  SmallAngleElements found;
  agreed(*level.comm, [&] {
    const std::vector<char> at_edge = nodes_at_sharp_edges(level, sharp_edges(level));
    for_own_elements_where(
        "pnpbs::small_angle_elements", level,
        [&](const Tetrahedron& t, const std::array<std::int64_t, 4>& corners) {
          return small.any(positions(t)) && !any_of(at_edge, corners) &&
                 !connects_thin_wall(level, centroid(t), least_spacing(t));
        },
        [&](const Tetrahedron& t, const std::array<std::int64_t, 4>&) {
          found.all.add(1, t[0].id, t[0].x);
          for (const VolumeNode& corner : t) found.places.push_back(corner.x);
        });
    std::ranges::sort(found.places);
    found.places.erase(std::unique(found.places.begin(), found.places.end()), found.places.end());
  });
  found.all = over_ranks(*level.comm, found.all);
  return found;
}

}  // namespace pnpbs
