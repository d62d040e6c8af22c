// SPDX-License-Identifier: BSD-3-Clause
#include "check/boundary_topology.hpp"

#include <algorithm>
#include <set>

#include "base/found_indices.hpp"
#include "level/volume/boundary_euler.hpp"
#include "level/volume/boundary_pieces.hpp"
#include "level/volume/loose_pieces.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

namespace {

// Returns true if an open face at the owned node i does not lie along a surface.
bool is_bridging(const Level<3>& level, std::int64_t i) {
  return level.nodes.owned(i) &&
         std::ranges::any_of(open_faces(level, i), [&](const FaceSide& side) {
           return !lies_along_surface(level, {i, side.first, side.second});
         });
}

}  // namespace

std::vector<Point<3>> points_of_other_topology(const Level<3>& level) {
  const BoundaryPieces pieces = boundary_pieces(level);
  std::vector<Point<3>> bridging, extra;
  collective_try(*level.comm, [&] {
    const std::set<std::int64_t> too_many = surplus_pieces(level, pieces);
    const auto at = [&](const auto& is_one) {
      std::vector<Point<3>> places;
      for (const std::int64_t i :
           indices_where("pnpbs::points_of_other_topology", level.nodes.count, is_one))
        places.push_back(level.nodes.position(i));
      return places;
    };
    bridging = at([&](std::int64_t i) { return is_bridging(level, i); });
    extra = at([&](std::int64_t i) {
      return level.nodes.owned(i) && too_many.contains(pieces.of[static_cast<std::size_t>(i)]);
    });
  });
  const std::uint64_t all_bridging = level.comm->allreduce_sum(bridging.size()),
                      all_extra = level.comm->allreduce_sum(extra.size());
  return all_extra > 0 && (all_bridging == 0 || all_extra < all_bridging) ? extra : bridging;
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
  result.pieces = pieces_of_boundary(level);
  if (level.geometry.cell().any()) {  // the surfaces are those of several copies
    result.euler_of_domain = result.euler;
    result.pieces_of_domain = result.pieces;
    return result;
  }
  result.euler_of_domain = euler_of_surfaces(level);
  result.pieces_of_domain = pieces_of_surfaces(level);
  return result;
}

}  // namespace pnpbs
