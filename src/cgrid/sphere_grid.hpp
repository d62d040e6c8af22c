// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells of the nodes on a sphere with their vertices and edges, for finite volume models
// that have velocities across the edges of the cells: a C-grid of arbitrary cells (T. Ringler, J.
// Thuburn, J. Klemp, W. Skamarock, Journal of Computational Physics 229, 2010, 3065-3090). Each
// inner node has a cell, each triangle at an inner node is a vertex of cells, and each pair of
// neighbours with at least one cell has an edge. Boundary nodes have no cell. An edge between a
// cell and a boundary node separates sea from land, as in culled grids.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hpp"
#include "cgrid/star_rings.hpp"
#include "results/results.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {

// A rank's part of the grid. Global numbers start at 0 and do not depend on the ranks.
struct SphereGrid {
  double radius = 0;  // of the sphere; all points below are on a unit sphere
  std::int64_t cells = 0, edges = 0, vertices = 0;  // numbers over all ranks
  int max_edges = 0;       // largest number of edges of a cell, over all ranks
  double min_spacing = 0;  // smallest spacing at a cell, over all ranks, unit sphere

  // Nodes: the owned ones in the order of their ids, then nodes of other ranks around them.
  std::int64_t owned = 0;
  std::vector<Point<3>> x;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> cell;  // number of the cell, or kNone
  std::vector<double> spacing;     // [owned], on the unit sphere

  std::vector<StarRings::Triangle> triangles;
  std::vector<Point<3>> centres;     // circumcentres of the triangles
  std::vector<std::int64_t> vertex;  // number, or kNone; set for triangles at owned nodes

  StarRings rings;
  std::vector<std::int64_t> edge;  // [entries of rings]: number, or kNone; set for owned
                                   // nodes and their neighbours
  std::vector<double> kite;        // [entries of rings]: area of the part of the cell that
                                   // belongs to the vertex between this neighbour and the next

  static constexpr std::int64_t kNone = -1;

  bool has_cell(std::int32_t node) const { return cell[static_cast<std::size_t>(node)] != kNone; }
  std::int64_t id(std::int32_t node) const { return ids[static_cast<std::size_t>(node)]; }
  const Point<3>& at(std::int32_t node) const { return x[static_cast<std::size_t>(node)]; }
  const Point<3>& centre(std::int32_t triangle) const {
    return centres[static_cast<std::size_t>(triangle)];
  }
  // Returns true if `node` leads the edge between the two neighbours. The leader is the first cell
  // of the edge.
  bool leads(std::int32_t node, std::int32_t other) const {
    return has_cell(node) && (!has_cell(other) || id(node) < id(other));
  }
  // Returns the node that leads a vertex: the one with the smallest id among those with a cell, or
  // -1.
  std::int32_t leader_of(std::int32_t triangle) const;
  // Returns the number of the edge, or kNone. One of the nodes must be owned or adjacent to an
  // owned one.
  std::int64_t edge_between(std::int32_t a, std::int32_t b) const;
  double area(std::int32_t node) const;  // of the node's cell
};

// Builds the grid of a placement on a sphere. Collective; if one rank throws, all ranks throw.
std::unique_ptr<SphereGrid> make_sphere_grid(Results<2>& results);

// Weights that give the velocity along an edge from the velocities across the edges around it. They
// conserve energy and keep geostrophic modes steady (J. Thuburn, T. Ringler, W. Skamarock, J.
// Klemp, Journal of Computational Physics 228, 2009, 8321-8335, equations 33 and 39).

// Returns the length of the Voronoi edge between the cell of a node and that of the neighbour at
// the index `place` of its ring.
inline double voronoi_edge_length(const SphereGrid& grid, std::int32_t node, std::int64_t place) {
  return arc(grid.centre(grid.rings.triangle(grid.rings.before(node, place))),
             grid.centre(grid.rings.triangle(place)));
}

// Calls visit(weight) for the other edges of a cell, counter-clockwise from the one at the index
// `place`. The weight is reduced by the share of the cell between the two edges. `sign` is 1 for
// the first cell of the edge and -1 for the second.
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
