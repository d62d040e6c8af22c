// SPDX-License-Identifier: BSD-3-Clause
// Every node's star in the Delaunay triangulation constrained to the boundary, from its adjacency
// list alone, so that each rank finds its own: ties are broken by id, and all agree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/chunked_rows.hpp"
#include "core/nodes.hpp"
#include "geometry/boundary_fans.hpp"
#include "geometry/domain_map.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"
#include "parallel/known_region.hpp"

namespace pnpbs {

// What the stars are found from; all for the same positions.
struct StarInput {
  const Nodes<2>& nodes;
  const DomainMap& map;
  const BoundaryFans& fans;
  const Buckets<2>& buckets;
  const AdjacencyList<2>& lists;
  const NearEdges& near_edges;
  const KnownRegion& known;
};

class DelaunayStars {
 public:
  struct Entry {
    std::uint32_t node : 31;
    std::uint32_t triangle : 1;
  };

  void build(const StarInput& input);

  // Calls visit(j, triangle) for the neighbours of node i, counter-clockwise; `triangle` tells
  // whether (i, j, next neighbour) is a triangle of the domain. The neighbour after the last is
  // the first.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    for (const Entry entry : stars_.row(i))
      visit(static_cast<std::int64_t>(entry.node), entry.triangle != 0);
  }

  // Calls visit(j, k) for the triangles (i, j, k) around node i.
  template <class Visit>
  void for_triangles(std::int64_t i, const Visit& visit) const {
    const std::span<const Entry> star = stars_.row(i);
    for (std::size_t k = 0; k < star.size(); ++k)
      if (star[k].triangle)
        visit(static_cast<std::int64_t>(star[k].node),
              static_cast<std::int64_t>(star[k + 1 < star.size() ? k + 1 : 0].node));
  }

  // 0 if the star of node i is there. Otherwise nodes this near to it would have to be known.
  double needs(std::int64_t i) const {
    return needs_.empty() ? 0 : needs_[static_cast<std::size_t>(i)];
  }

  std::int32_t size(std::int64_t i) const {
    return static_cast<std::int32_t>(stars_.row(i).size());
  }

 private:
  ChunkedRows<Entry> stars_;
  std::vector<double> needs_;  // of the nodes; empty where everything is known
};

}  // namespace pnpbs
