// SPDX-License-Identifier: BSD-3-Clause
#include "placement/element_angles.hpp"

#include <algorithm>
#include <array>

#include "delaunay/volume/element_rule.hpp"
#include "quality/volume/small_angles.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "shape/sharp_edges.hpp"

namespace pnpbs {

namespace {

// By memory index, ghosts too, which may be corners: is the node less than d from a sharp edge?
std::vector<char> nodes_at_sharp_edges(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<char> at_edge(static_cast<std::size_t>(nodes.count));
  const SharpEdges edges(level.ground.boundary(), level.ground.surface().features());
  if (!edges.none())
    for_each("pnpbs::nodes_at_sharp_edges", nodes.count, [&](std::int64_t i) {
      at_edge[static_cast<std::size_t>(i)] = edges.any_nearer(nodes.position(i), nodes.d(i));
    });
  return at_edge;
}

std::array<Point<3>, 4> positions(const Tetrahedron& t) { return {t[0].x, t[1].x, t[2].x, t[3].x}; }

// Calls visit(element, at_sharp_edge) for the elements of which this rank owns the node with the
// least id; their corners in the order of ids, so that the bits of an angle do not depend on ranks.
template <class Visit>
void for_own_elements(const Level<3>& level, const Visit& visit) {
  const Nodes<3>& nodes = level.nodes;
  const std::vector<char> at_edge = nodes_at_sharp_edges(level);
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
      const std::array<std::int64_t, 4> corners{i, others[0], others[1], others[2]};
      const Tetrahedron t = ordered_by_id(tetrahedron_of(nodes, corners));
      if (t[0].id != nodes.id(i)) return;
      visit(t, std::ranges::any_of(corners, [&](std::int64_t c) {
              return at_edge[static_cast<std::size_t>(c)] != 0;
            }));
    });
  }
}

}  // namespace

LeastAngles least_angles(const Level<3>& level) {
  LeastAngles least;
  agreed(*level.comm, [&] {
    for_own_elements(level, [&](const Tetrahedron& t, bool at_sharp_edge) {
      double& of_kind = at_sharp_edge ? least.at_sharp_edges : least.elsewhere;
      of_kind = std::min(of_kind, min_dihedral_angle(positions(t)));
    });
  });
  return {-level.comm->allreduce_max(-least.at_sharp_edges),
          -level.comm->allreduce_max(-least.elsewhere)};
}

SmallAngleElements small_angle_elements(const Level<3>& level, double below) {
  const SmallAngles small(below);
  SmallAngleElements found;
  agreed(*level.comm, [&] {
    for_own_elements(level, [&](const Tetrahedron& t, bool at_sharp_edge) {
      if (at_sharp_edge || !small.any(positions(t))) return;
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
