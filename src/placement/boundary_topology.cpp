// SPDX-License-Identifier: BSD-3-Clause
#include "placement/boundary_topology.hpp"

#include <algorithm>

#include "level/volume/boundary_euler.hpp"
#include "level/volume/boundary_pieces.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

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

BoundaryTopology boundary_topology(const Results<3>& results, std::vector<Point<3>>& torn) {
  const Level<3>& level = results.level();
  const Nodes<3>& nodes = level.nodes;
  BoundaryTopology result;
  std::uint64_t on_surfaces = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    const FaceFan fan = open_faces(level, i);
    const bool is_free = nodes.carrier(i) == Carrier::free;
    const bool torn_here = is_free ? !fan.empty() : lacks_disks(level, i, fan);
    result.torn.add(torn_here, nodes.id(i), nodes.position(i));
    if (torn_here) {
      on_surfaces += !is_free;
      torn.push_back(nodes.position(i));
      level.stars.for_neighbours(i, [&](std::int64_t j) { torn.push_back(nodes.position(j)); });
    }
  }
  result.torn = over_ranks(results.communicator(), result.torn);
  result.torn_on_surfaces = results.communicator().allreduce_sum(on_surfaces) > 0;
  result.euler = euler_of_boundary(level);
  result.euler_of_domain = euler_of_surfaces(level);
  result.pieces = pieces_of_boundary(level);
  result.pieces_of_domain = pieces_of_surfaces(level);
  return result;
}

}  // namespace pnpbs
