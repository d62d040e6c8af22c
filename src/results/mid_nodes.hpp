// SPDX-License-Identifier: BSD-3-Clause
// The mid nodes of elements of second order, one on each edge. Edges of facets follow the curves
// and surfaces of the domain, except where an element would fold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "results/curved_elements.hpp"
#include "results/results.hpp"

namespace pnpbs {

// An edge and its mid node.
struct MidNode {
  std::array<std::int32_t, 2> ends;  // result indices, ascending
  std::int64_t number;  // 0, 1, ... over all ranks, in the order of the ids of the ends
  Point<3> x;           // in the coordinates of the user; z is 0 in the plane
  std::int32_t tag;     // the smallest of the facets at the edge; 0 if there are none
  std::int32_t region;  // the smallest of the elements at the edge
  bool on_facet;        // whether it is an edge of a facet
  bool first;           // true on exactly one of the ranks that have the edge
};

// The mid nodes of the edges of this rank's elements and facets.
class MidNodes {
 public:
  const std::vector<MidNode>& nodes() const { return nodes_; }  // ordered by their ends
  std::int64_t all() const { return all_; }                     // over all ranks
  // Number of edges over all ranks that are straight, because an element would fold.
  std::int64_t straight() const { return straight_; }

  // Returns the indices in nodes() of the edges of an element or facet, given by the result indices
  // of its corners, in the order of kElementEdges; -1 for edges that this rank does not have.
  template <std::size_t corners>
  std::array<std::int64_t, edges_of(corners)> of(
      const std::array<std::int64_t, corners>& places) const {
    std::array<std::int64_t, edges_of(corners)> indices;
    for (std::size_t e = 0; e < indices.size(); ++e)
      indices[e] = between(places[kElementEdges[e][0]], places[kElementEdges[e][1]]);
    return indices;
  }

 private:
  template <int Dim>
  friend class MidNodeMaker;

  std::int64_t between(std::int64_t a, std::int64_t b) const;

  std::vector<MidNode> nodes_;
  std::vector<std::int64_t> begin_;  // for each result index, the first edge with it as lower end
  std::int64_t all_ = 0, straight_ = 0;
};

// Returns the mid nodes. They have the same positions and numbers on any number of ranks.
// Collective.
template <int Dim>
MidNodes make_mid_nodes(Results<Dim>& results);

extern template MidNodes make_mid_nodes(Results<2>&);
extern template MidNodes make_mid_nodes(Results<3>&);

}  // namespace pnpbs
