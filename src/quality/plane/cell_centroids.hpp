// SPDX-License-Identifier: BSD-3-Clause
// Centroids of Voronoi cells for the density d^-4. Nodes at these centroids form a centroidal
// Voronoi tessellation: in the plane with cells as wide as d (Q. Du, M. Gunzburger, L. Ju, SIAM J.
// Sci. Comput. 24, 2003, 1488-1506), and on a sphere, where the centroid in space is projected back
// along its ray (T. Ringler, L. Ju, M. Gunzburger, Ocean Dynamics 58, 2008, 475-498).
#pragma once

#include <cstdint>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// Evaluates the centroids of the cells of moving nodes. d is interpolated linearly on each
// triangle.
class CellCentroids {
 public:
  // `nodes` and `stars` must outlive this object.
  CellCentroids(const Nodes<2>& nodes, const DelaunayStars& stars, const Embedding<2>& embedding)
      : nodes_(nodes), stars_(stars), embedding_(embedding) {}

  // Returns whether node i moves and its cell is complete.
  bool has(std::int64_t i) const {
    return nodes_.moves(i) && stars_.closed(i) && stars_.size(i) >= 3;
  }
  // Returns the centroid of the cell of node i, in the plane or in the chart. has(i) must be true.
  // The cell is clipped at edges between two nodes that do not move, as at a boundary. The
  // triangles are summed in the order of the star, which begins at the same neighbour on every
  // rank, so all ranks compute the same bits.
  Point<2> of(std::int64_t i) const;

 private:
  const Nodes<2>& nodes_;
  const DelaunayStars& stars_;
  Embedding<2> embedding_;
};

}  // namespace pnpbs
