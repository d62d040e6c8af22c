// SPDX-License-Identifier: BSD-3-Clause
// The first row of inner nodes along the boundary. Boundary nodes are fixed, and rows of bubbles at
// rest slip against them where d grows from a boundary or the boundary is curved; this makes the
// worst triangles. An advancing front begins with one node over each boundary edge (S. H. Lo, Int.
// J. Numer. Methods Eng. 21, 1985, 1403-1426; with equilateral triangles, D. Engwirda, D. Ivers,
// Comput.-Aided Des. 72, 2016, 157-171). Such a row replaces the nodes that bubbles have formed.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "neighbors/adjacency_list.hpp"
#include "population/population.hpp"
#include "quality/plane/boundary_apexes.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// Depth of ghosts that choose_first_row() requires. [hops of the lists] A node may be deleted
// because of a node one hop away, which depends on apexes over edges one hop farther. Whether these
// stand depends on others within two hops.
inline constexpr int kFirstRowHops = 4;

// The changes that create the first row: nodes to move and a population change.
struct FirstRow {
  // The move of a node to an apex.
  struct Move {
    std::int32_t node;
    Point<2> to;
  };
  std::vector<Move> moved;  // may contain ghosts
  PopulationChange<2> change;
};

// Chooses the nodes that form the first row, the owned nodes to delete and the nodes to insert.
// `lists` must be valid for the current positions. boundary_spacing(b) returns d at boundary node
// b.
FirstRow choose_first_row(const Nodes<2>& nodes, const AdjacencyList<2>& lists,
                          const SizedTree<2>& map, const IncidentSectors& sectors,
                          const std::function<double(std::int32_t)>& boundary_spacing);

}  // namespace pnpbs
