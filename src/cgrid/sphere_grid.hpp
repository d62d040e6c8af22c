// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells of the nodes on a sphere with their vertices and edges, as finite volume models
// take them that have velocities across the edges of the cells: a C-grid of arbitrary cells
// (Ringler, Thuburn, Klemp and Skamarock, Journal of Computational Physics 229 (2010), 3065-3090).
// Each inner node has a cell, each triangle at one of them is a vertex of cells, and an edge is
// between a cell and any node beside it. Nodes of the boundary have none: where there is one, what
// lies beyond an edge is land, as it is in grids that have been culled.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hpp"
#include "cgrid/star_rings.hpp"
#include "results/results.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {

struct SphereGrid {
  double radius = 0;                                // all points are on a sphere of radius 1
  std::int64_t cells = 0, edges = 0, vertices = 0;  // of all ranks
  int max_edges = 0;                                // of a cell; of all ranks
  double min_spacing = 0;  // at a cell; of all ranks, on a sphere of radius 1

  // Nodes of this rank in the order of their ids, then those of others around them.
  std::int64_t owned = 0;
  std::vector<Point<3>> x;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> cell;  // its number, or kNone
  std::vector<double> spacing;     // [owned], on a sphere of radius 1

  std::vector<StarRings::Triangle> triangles;
  std::vector<Point<3>> centres;     // of their circles
  std::vector<std::int64_t> vertex;  // its number, or kNone; of triangles at owned nodes

  StarRings rings;
  std::vector<std::int64_t> edge;  // [places in rings] its number, or kNone; at owned nodes and
                                   // their neighbours
  std::vector<double> kite;  // [places in rings] the part of a cell that is nearest to the vertex
                             // between this neighbour and the next one

  static constexpr std::int64_t kNone = -1;

  bool has_cell(std::int32_t node) const { return cell[static_cast<std::size_t>(node)] != kNone; }
  std::int64_t id(std::int32_t node) const { return ids[static_cast<std::size_t>(node)]; }
  const Point<3>& at(std::int32_t node) const { return x[static_cast<std::size_t>(node)]; }
  const Point<3>& centre(std::int32_t triangle) const {
    return centres[static_cast<std::size_t>(triangle)];
  }
  // Does the first of these neighbours lead their edge? It is the first cell at it.
  bool leads(std::int32_t node, std::int32_t other) const {
    return has_cell(node) && (!has_cell(other) || id(node) < id(other));
  }
  // The node with a cell that has the least id at a vertex; -1 if none has.
  std::int32_t leader_of(std::int32_t triangle) const;
  // Its number, or kNone. One of the nodes is an own one or beside one.
  std::int64_t edge_between(std::int32_t a, std::int32_t b) const;
  double area(std::int32_t node) const;  // of its cell
};

// Of a placement on a sphere. Collective, and agreed.
std::unique_ptr<SphereGrid> make_sphere_grid(Results<2>& results);

// Velocity along an edge of the grid from those across the edges around: weights that conserve
// energy and keep geostrophic modes steady (J. Thuburn, T. Ringler, W. Skamarock and J. Klemp,
// Journal of Computational Physics 228 (2009), 8321-8335, equations 33 and 39).

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
