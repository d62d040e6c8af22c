// SPDX-License-Identifier: BSD-3-Clause
#include "placement/boundary_topology.hpp"

#include <algorithm>

#include "base/found_indices.hpp"
#include "level/volume/boundary_euler.hpp"
#include "level/volume/boundary_pieces.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

namespace {

bool is_bridging(const Level<3>& level, std::int64_t i) {
  return level.nodes.owned(i) &&
         std::ranges::any_of(open_faces(level, i), [&](const FaceSide& side) {
           return !lies_along_surface(level, {i, side.first, side.second});
         });
}

}  // namespace

std::vector<Point<3>> bridging_nodes(const Level<3>& level) {
  std::vector<Point<3>> bridging;
  for (const std::int64_t i : indices_where("pnpbs::bridging_nodes", level.nodes.count,
                                            [&](std::int64_t k) { return is_bridging(level, k); }))
    bridging.push_back(level.nodes.position(i));
  return bridging;
}

BoundaryTopology boundary_topology(const Results<3>& results, std::vector<Point<3>>& torn) {
  const Level<3>& level = results.level();
  const Nodes<3>& nodes = level.nodes;
  BoundaryTopology result;
  std::uint64_t on_surfaces = 0;
  for (const std::int64_t i :
       indices_where("pnpbs::boundary_topology", nodes.count,
                     [&](std::int64_t k) { return is_torn_around(level, k); })) {
    on_surfaces += nodes.carrier(i) != Carrier::free;
    result.torn.add(1, nodes.id(i), nodes.position(i));
    torn.push_back(nodes.position(i));
    level.stars.for_neighbours(i, [&](std::int64_t j) { torn.push_back(nodes.position(j)); });
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
