// SPDX-License-Identifier: BSD-3-Clause
// The centroids of Voronoi cells for the density d^-4: nodes that lie at them are a centroidal
// Voronoi tessellation, in the plane with cells as wide as d (Q. Du, M. Gunzburger, L. Ju, SIAM J.
// Sci. Comput. 24, 2003, 1488-1506) and on a sphere, where the centroid in space is taken back
// along its ray (T. Ringler, L. Ju, M. Gunzburger, Ocean Dynamics 58, 2008, 475-498).
#pragma once

#include <cstdint>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

class CellCentroids {
 public:
  // d is linear on each triangle.
  CellCentroids(const Nodes<2>& nodes, const DelaunayStars& stars, const Embedding<2>& embedding)
      : nodes_(nodes), stars_(stars), embedding_(embedding) {}

  // Does node i move, and is its cell whole?
  bool has(std::int64_t i) const {
    return nodes_.moves(i) && stars_.closed(i) && stars_.size(i) >= 3;
  }
  // Of the cell of such a node, in the plane or the chart. Where it reaches across an edge between
  // two nodes that do not move, as at a boundary, it is cut off there. Stars begin where their
  // nodes say, so that every rank computes the same bits.
  Point<2> of(std::int64_t i) const;

 private:
  const Nodes<2>& nodes_;
  const DelaunayStars& stars_;
  Embedding<2> embedding_;
};

}  // namespace pnpbs
