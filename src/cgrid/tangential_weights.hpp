// SPDX-License-Identifier: BSD-3-Clause
// Velocity along an edge of the grid from those across the edges around: weights that conserve
// energy and keep geostrophic modes steady (J. Thuburn, T. Ringler, W. Skamarock and J. Klemp,
// Journal of Computational Physics 228 (2009), 8321-8335, equations 33 and 39).
#pragma once

#include "cgrid/sphere_grid.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {

// The Voronoi edge between the cell of a node and that at this place of its ring.
inline double voronoi_edge_length(const SphereGrid& grid, std::int32_t node, std::int64_t place) {
  return arc(grid.centre(grid.rings.triangle(grid.rings.before(node, place))),
             grid.centre(grid.rings.triangle(place)));
}

// Calls visit(weight) for the other edges of a cell, counter-clockwise from the
// one at this place. What the weight leaves out is the part of the cell that lies between. sign: 1
// for the first cell at the edge, -1 for the second.
template <class Visit>
void for_tangential_weights(const SphereGrid& grid, std::int32_t node, std::int64_t place,
                            double sign, const Visit& visit) {
  const StarRings& rings = grid.rings;
  const double area = grid.area(node);
  const double across = arc(grid.at(node), grid.at(rings.neighbour(place)));
  double between = 0;
  for (std::int64_t before = place, k = rings.next(node, place); k != place;
       before = k, k = rings.next(node, k)) {
    between += grid.kite[static_cast<std::size_t>(before)] / area;
    const double outward = grid.leads(node, rings.neighbour(k)) ? 1 : -1;
    visit(sign * outward * (0.5 - between) * voronoi_edge_length(grid, node, k) / across);
  }
}

}  // namespace pnpbs
