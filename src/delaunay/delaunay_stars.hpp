// SPDX-License-Identifier: BSD-3-Clause
// The star of every node of the plane in the Delaunay triangulation constrained to the boundary. A
// star is found from the adjacency list of its node, so that each rank finds those of its nodes.
// Ties are broken by id, so that the stars of all ranks form one triangulation.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/nodes.hpp"
#include "domain/plane/plane_domain.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/near_edges.hpp"
#include "partition/known_region.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// The data from which the stars are found, all for the same positions.
struct StarInput {
  const Nodes<2>& nodes;
  const SizedTree<2>& map;
  const IncidentSectors& sectors;
  const Buckets<2>& buckets;
  const AdjacencyList<2>& lists;
  const NearEdges& near_edges;
  const KnownRegion<2>& known;
  const PlaneDomain& domain;  // Locates the patch of a whole sphere.
};

// The stars of all nodes of this rank, stored in blocks of kLanes nodes like adjacency lists: the
// k-th neighbours of a block are contiguous.
class DelaunayStars {
 public:
  // A number and a flag in one word. For a neighbour j, the flag says whether (i, j, next
  // neighbour) is a triangle of the domain.
  struct Entry {
    std::uint32_t bits;

    Entry() = default;
    Entry(std::int64_t value, bool flag)
        : bits(static_cast<std::uint32_t>(value) | (flag ? 0x80000000U : 0U)) {}
    std::int32_t value() const { return static_cast<std::int32_t>(bits & 0x7fffffffU); }
    bool flag() const { return bits >> 31 != 0; }
  };

  struct Block {
    const Entry* sizes;    // [kLanes]; the flag says whether the star consists of triangles only.
    const Entry* entries;  // [length][kLanes]; shorter stars are padded with their first entry.
    std::int32_t length;
  };

  using Corners = std::array<std::int64_t, 2>;

  void build(const StarInput& input);
  // Returns whether the stars are of these nodes in their present order in memory. The nodes may
  // have moved since the stars were found.
  bool are_of(const Nodes<2>& nodes) const { return arrangement_ == nodes.arrangement(); }

  std::int64_t block_count() const { return (count_ + kLanes - 1) / kLanes; }

  Block block(std::int64_t b) const {
    const std::span<const Entry> rows = blocks_.row(b);
    return {rows.data(), rows.data() + kLanes, static_cast<std::int32_t>(rows.size() / kLanes) - 1};
  }

  // Calls visit(j) for the neighbours of node i.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    for_neighbours_in_order(i, [&](std::int64_t j, bool) { visit(j); });
  }

  // Calls visit(corners) for the triangles of the domain around node i. `corners` are the two other
  // corners, which follow node i counter-clockwise.
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    const Row star = row(i);
    for (std::int32_t k = 0; k < star.size; ++k) {
      if (!star.at(k).flag()) continue;
      const Entry next = star.at(k + 1 < star.size ? k + 1 : 0);
      visit(Corners{star.at(k).value(), next.value()});
    }
  }

  // --- only in the plane: cyclic order ---

  // Calls visit(j, triangle) for the neighbours of node i in counter-clockwise order. `triangle`
  // says whether (i, j, next neighbour) is a triangle of the domain. The first neighbour follows
  // the last.
  template <class Visit>
  void for_neighbours_in_order(std::int64_t i, const Visit& visit) const {
    const Row star = row(i);
    for (std::int32_t k = 0; k < star.size; ++k)
      visit(static_cast<std::int64_t>(star.at(k).value()), star.at(k).flag());
  }

  // Returns 0 if the star of node i has been found. Otherwise returns the distance up to which all
  // nodes around it must be known. In the patch of a whole sphere, it is the length of a SphereCap
  // around it.
  double needs(std::int64_t i) const {
    return needs_.empty() ? 0 : needs_[static_cast<std::size_t>(i)];
  }

  std::int32_t size(std::int64_t i) const { return block(i / kLanes).sizes[i % kLanes].value(); }
  // Returns whether the star consists of triangles only.
  bool closed(std::int64_t i) const { return block(i / kLanes).sizes[i % kLanes].flag(); }

  // Rotates the star of node i so that it begins with the neighbour at index `place`.
  void begin_with(std::int64_t i, std::int32_t place);
  // Replaces the stars of the nodes for which `changed` is set by star_of(i).
  void rewrite(const std::vector<char>& changed,
               const std::function<std::vector<Entry>(std::int64_t)>& star_of);

  // --- changes that last until the next build; the caller keeps the triangles consistent ---
  void replace(std::int64_t i, std::int64_t neighbour, std::int64_t by);
  void remove(std::int64_t i, std::int64_t neighbour);
  void clear(std::int64_t i);

 private:
  // Read access to the star of a node in its block.
  struct Row {
    const Entry* first;
    std::int32_t size;

    const Entry& at(std::int32_t k) const { return first[k * kLanes]; }
  };
  Row row(std::int64_t i) const {
    const Block stars = block(i / kLanes);
    const std::int64_t lane = i % kLanes;
    return {stars.entries + lane, stars.sizes[lane].value()};
  }
  // Write access to the star of a node in its block.
  struct Column {
    Entry* size;
    Entry* first;
    std::int32_t length;  // Length of the block.

    Entry& at(std::int32_t k) const { return first[k * kLanes]; }
  };
  Column column(std::int64_t i);
  std::int32_t place_in_star(const Column& star, std::int64_t neighbour) const;
  void append_block(std::int64_t b, const std::array<std::vector<Entry>, kLanes>& stars,
                    std::vector<Entry>& out) const;

  std::int64_t count_ = 0, arrangement_ = -1;
  ChunkedRows<Entry, 64> blocks_;  // Sizes, then entries of each block.
  std::vector<double> needs_;      // One per node; empty if all nodes are known everywhere.
};

}  // namespace pnpbs
