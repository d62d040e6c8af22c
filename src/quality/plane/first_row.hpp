// SPDX-License-Identifier: BSD-3-Clause
// The first row of inner nodes. Boundary nodes do not move, and rows of bubbles at rest slip
// against them where d grows from a boundary or it is bent: the triangles between are the worst of
// all. An advancing front begins with one node over each edge of the boundary (S. H. Lo, Int. J.
// Numer. Methods Eng. 21, 1985, 1403-1426; with equilateral triangles, D. Engwirda, D. Ivers,
// Comput.-Aided Des. 72, 2016, 157-171). Such a row replaces what bubbles have made.
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

// In hops of the lists. A node may be ousted by one a hop away, which knows the apexes over edges a
// hop farther. Whether these stand depends on others, within two hops.
inline constexpr int kFirstRowHops = 4;

struct FirstRow {
  struct Move {
    std::int32_t node;
    Point<2> to;
  };
  std::vector<Move> moved;  // ghosts among them
  PopulationChange<2> change;
};

// Of nodes for which lists are there, where they are now: the change of owned ones.
FirstRow choose_first_row(const Nodes<2>& nodes, const AdjacencyList<2>& lists,
                          const SizedTree<2>& map, const IncidentSectors& sectors,
                          const std::function<double(std::int32_t)>& boundary_spacing);

}  // namespace pnpbs
