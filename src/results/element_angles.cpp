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

// Returns, by memory index and for ghosts as well, whether a node is less than d from a sharp edge.
// Ghosts can be corners of elements.
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
  return {level.geometry.boundary(), level.geometry.surface().features()};
}

bool any_of(const std::vector<char>& nodes, const std::array<std::int64_t, 4>& corners) {
  return std::ranges::any_of(
      corners, [&](std::int64_t c) { return nodes[static_cast<std::size_t>(c)] != 0; });
}

std::array<Point<3>, 4> positions(const Tetrahedron& t) { return {t[0].x, t[1].x, t[2].x, t[3].x}; }

// The largest dihedral angle of elements that connect the sides of a wall of kThinWall d:
// tan^-1(0.25 / 0.87) = 16. Only smaller angles require the test for a thin wall. [degrees]
// geometry.
constexpr double kLeastInBulk = 16;

bool is_in_thin_wall(const Level<3>& level, const Tetrahedron& t) {
  return connects_thin_wall(level, centroid(t), std::ranges::min_element(t, {}, &VolumeNode::d)->d);
}

}  // namespace

LeastAngles least_angles(const Level<3>& level, double of_all) {
  const SharpEdges edges = sharp_edges(level);
  if (edges.none() && of_all > kLeastInBulk) return {180, of_all};
  LeastAngles least;
  collective_try(*level.comm, [&] {
    const std::vector<char> at_edge = nodes_at_sharp_edges(level, edges);
    least = sums_over(
        "pnpbs::least_angles", level.nodes.count, LeastAngles(),
        [&](std::int64_t i, LeastAngles& angles) {
          for_own_elements_at(
              level, i, [&](const Tetrahedron& t, const std::array<std::int64_t, 4>& corners) {
                const double angle = min_dihedral_angle(positions(t));
                angles.add(angle, any_of(at_edge, corners) ||
                                      (angle < kLeastInBulk && is_in_thin_wall(level, t)));
              });
        });
  });
  return {-level.comm->allreduce_max(-least.at_sharp_edges),
          -level.comm->allreduce_max(-least.elsewhere)};
}

SmallAngleElements small_angle_elements(const Level<3>& level, double below) {
  const SmallAngles small(below);
  SmallAngleElements found;
  collective_try(*level.comm, [&] {
    const std::vector<char> at_edge = nodes_at_sharp_edges(level, sharp_edges(level));
    for_own_elements_where(
        "pnpbs::small_angle_elements", level,
        [&](const Tetrahedron& t, const std::array<std::int64_t, 4>& corners) {
          return small.any(positions(t)) && !any_of(at_edge, corners) && !is_in_thin_wall(level, t);
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
