// SPDX-License-Identifier: BSD-3-Clause
// Every node's star in the Delaunay triangulation constrained to the boundary, from its adjacency
// list alone, so that each rank finds its own: ties are broken by id, and all agree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/nodes.hpp"
#include "geometry/boundary_fans.hpp"
#include "geometry/domain_map.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

// What the stars are found from; all for the same positions.
struct StarInput {
  const Nodes<2>& nodes;
  const DomainMap& map;
  const BoundaryFans& fans;
  const Buckets<2>& buckets;
  const AdjacencyList<2>& lists;
  const NearEdges& near_edges;
};

class DelaunayStars {
 public:
  void build(const StarInput& input);

  // Calls visit(j, triangle) for the neighbours of node i, counter-clockwise; `triangle` tells
  // whether (i, j, next neighbour) is a triangle of the domain. The neighbour after the last is
  // the first.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const Chunk& chunk = chunk_of(i);
    for (std::int32_t k = begin(i); k < end(i); ++k) {
      const Entry entry = chunk.entries[static_cast<std::size_t>(k)];
      visit(static_cast<std::int64_t>(entry.node), entry.triangle != 0);
    }
  }

  // Calls visit(j, k) for the triangles (i, j, k) around node i.
  template <class Visit>
  void for_triangles(std::int64_t i, const Visit& visit) const {
    const Chunk& chunk = chunk_of(i);
    for (std::int32_t k = begin(i); k < end(i); ++k) {
      const Entry entry = chunk.entries[static_cast<std::size_t>(k)];
      const std::int32_t after = k + 1 < end(i) ? k + 1 : begin(i);
      if (entry.triangle)
        visit(static_cast<std::int64_t>(entry.node),
              static_cast<std::int64_t>(chunk.entries[static_cast<std::size_t>(after)].node));
    }
  }

  std::int32_t size(std::int64_t i) const { return end(i) - begin(i); }

  struct Entry {
    std::uint32_t node : 31;
    std::uint32_t triangle : 1;
  };

 private:
  static constexpr std::int64_t kChunkNodes = 512;
  struct Chunk {
    std::vector<Entry> entries;
    std::array<std::int32_t, kChunkNodes + 1> offset{};
  };
  const Chunk& chunk_of(std::int64_t i) const {
    return chunks_[static_cast<std::size_t>(i / kChunkNodes)];
  }
  std::int32_t begin(std::int64_t i) const {
    return chunk_of(i).offset[static_cast<std::size_t>(i % kChunkNodes)];
  }
  std::int32_t end(std::int64_t i) const {
    return chunk_of(i).offset[static_cast<std::size_t>(i % kChunkNodes) + 1];
  }

  std::vector<Chunk> chunks_;
};

}  // namespace pnpbs
