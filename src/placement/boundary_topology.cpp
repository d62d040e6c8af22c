// SPDX-License-Identifier: BSD-3-Clause
#include "placement/boundary_topology.hpp"

#include <algorithm>
#include <array>

#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

namespace {

using Counts = std::array<std::int64_t, 3>;  // of vertices, edges and triangles

std::int64_t euler_of(const Counts& counts) { return counts[0] - counts[1] + counts[2]; }

template <class T>
std::int64_t distinct(std::vector<T>& values) {
  std::ranges::sort(values);
  return std::unique(values.begin(), values.end()) - values.begin();
}

std::int64_t euler_of_surfaces(const BoundaryMesh<3>& mesh, const Features& features) {
  std::vector<std::int32_t> vertices;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::int64_t triangles = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (features.patch[f] < 0 || !mesh.facets[f].bounds()) continue;
    ++triangles;
    const auto& nodes = mesh.facets[f].nodes;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = nodes[k], b = nodes[(k + 1) % 3];
      vertices.push_back(a);
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  return euler_of({distinct(vertices), distinct(edges), triangles});
}

}  // namespace

std::vector<Point<3>> bridging_nodes(const Level<3>& level) {
  std::vector<Point<3>> bridging;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    if (!level.nodes.owned(i)) continue;
    const auto bridges = [&](const FaceSide& side) {
      return !lies_along_surface(level, {i, side.first, side.second});
    };
    if (std::ranges::any_of(open_faces(level, i), bridges))
      bridging.push_back(level.nodes.position(i));
  }
  return bridging;
}

BoundaryTopology boundary_topology(const PlacementOf<3>& placement, std::vector<Point<3>>& torn) {
  const Level<3>& level = placement.level();
  const Nodes<3>& nodes = level.nodes;
  BoundaryTopology result;
  std::int64_t vertices = 0, corners = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    const FaceFan fan = open_faces(level, i);
    const bool is_free = nodes.carrier(i) == Carrier::free;
    const std::int64_t disks = disks_of_surfaces(level, i);
    const bool torn_here = is_free ? !fan.empty() : disks > 0 && disks_of(fan) != disks;
    result.torn.add(torn_here, nodes.id(i), nodes.position(i));
    if (torn_here) {
      torn.push_back(nodes.position(i));
      level.stars.for_neighbours(i, [&](std::int64_t j) { torn.push_back(nodes.position(j)); });
    }
    vertices += !fan.empty();
    corners += std::ssize(fan);
  }
  const auto sum = [&](std::int64_t own) {
    return static_cast<std::int64_t>(
        placement.communicator().allreduce_sum(static_cast<std::uint64_t>(own)));
  };
  result.torn = over_ranks(placement.communicator(), result.torn);
  vertices = sum(vertices);
  corners = sum(corners);
  result.euler = euler_of({vertices, corners / 2, corners / 3});
  result.euler_of_domain =
      euler_of_surfaces(level.ground.boundary(), level.ground.domain().features());
  return result;
}

}  // namespace pnpbs
