// SPDX-License-Identifier: BSD-3-Clause
// Every node's star in the Delaunay triangulation constrained to the boundary, from its adjacency
// list alone, so that each rank finds its own: ties are broken by id, and all agree.
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

// What the stars are found from; all for the same positions.
struct StarInput {
  const Nodes<2>& nodes;
  const SizedTree<2>& map;
  const IncidentSectors& sectors;
  const Buckets<2>& buckets;
  const AdjacencyList<2>& lists;
  const NearEdges& near_edges;
  const KnownRegion<2>& known;
  const PlaneDomain& domain;  // tells where the patch of a whole sphere is
};

// Laid out like the lists: in blocks of kLanes nodes, the k-th neighbours of a block side by side.
class DelaunayStars {
 public:
  // A number and a flag. Of a neighbour j: is (i, j, next neighbour) a triangle of the domain?
  struct Entry {
    std::uint32_t bits;

    Entry() = default;
    Entry(std::int64_t value, bool flag)
        : bits(static_cast<std::uint32_t>(value) | (flag ? 0x80000000U : 0U)) {}
    std::int32_t value() const { return static_cast<std::int32_t>(bits & 0x7fffffffU); }
    bool flag() const { return bits >> 31 != 0; }
  };

  struct Block {
    const Entry* sizes;    // [kLanes]; flagged if the star is all triangles
    const Entry* entries;  // [length][kLanes]; shorter stars are filled up with their first entry
    std::int32_t length;
  };

  using Corners = std::array<std::int64_t, 2>;

  void build(const StarInput& input);
  // Were they found for these nodes, in this order in memory? They may have moved since.
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

  // Calls visit(corners) for the triangles of the domain around node i: their other corners, so
  // that node i and these follow each other counter-clockwise.
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    const Row star = row(i);
    for (std::int32_t k = 0; k < star.size; ++k) {
      if (!star.at(k).flag()) continue;
      const Entry next = star.at(k + 1 < star.size ? k + 1 : 0);
      visit(Corners{star.at(k).value(), next.value()});
    }
  }

  // --- what only the plane has: a cyclic order ---
  // Calls visit(j, triangle) for the neighbours of node i, counter-clockwise; `triangle` tells
  // whether (i, j, next neighbour) is a triangle of the domain. The neighbour after the last is
  // the first.
  template <class Visit>
  void for_neighbours_in_order(std::int64_t i, const Visit& visit) const {
    const Row star = row(i);
    for (std::int32_t k = 0; k < star.size; ++k)
      visit(static_cast<std::int64_t>(star.at(k).value()), star.at(k).flag());
  }

  // 0 if the star of node i is there. Otherwise nodes this near to it would have to be known; in
  // the patch of a whole sphere, all that a SphereCap of this length around it holds.
  double needs(std::int64_t i) const {
    return needs_.empty() ? 0 : needs_[static_cast<std::size_t>(i)];
  }

  std::int32_t size(std::int64_t i) const { return block(i / kLanes).sizes[i % kLanes].value(); }
  // Is the star all triangles?
  bool closed(std::int64_t i) const { return block(i / kLanes).sizes[i % kLanes].flag(); }

  // The star of node i begins with the neighbour that is at this place in it.
  void begin_with(std::int64_t i, std::int32_t place);
  // The stars of those nodes for which changed is set become star_of(i).
  void rewrite(const std::vector<char>& changed,
               const std::function<std::vector<Entry>(std::int64_t)>& star_of);

  // --- changes by hand, until the next build; the triangles left are the caller's business ---
  void replace(std::int64_t i, std::int64_t neighbour, std::int64_t by);
  void remove(std::int64_t i, std::int64_t neighbour);
  void clear(std::int64_t i);

 private:
  // The star of a node as it lies in its block, to read.
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
  // The same, to change.
  struct Column {
    Entry* size;
    Entry* first;
    std::int32_t length;  // of the block

    Entry& at(std::int32_t k) const { return first[k * kLanes]; }
  };
  Column column(std::int64_t i);
  std::int32_t place_in_star(const Column& star, std::int64_t neighbour) const;
  void append_block(std::int64_t b, const std::array<std::vector<Entry>, kLanes>& stars,
                    std::vector<Entry>& out) const;

  std::int64_t count_ = 0, arrangement_ = -1;
  ChunkedRows<Entry, 64> blocks_;  // the sizes, then the entries
  std::vector<double> needs_;      // of the nodes; empty where everything is known
};

}  // namespace pnpbs
