// SPDX-License-Identifier: BSD-3-Clause
// What each node stands for: the volumes of Voronoi cells, for files and in figures.
#pragma once

#include <optional>

#include "tool/density.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

struct VolumeFigures {
  int dimension;  // of the elements: volumes are areas if it is 2
  double total;   // of all nodes
  // Over nodes, of a node's volume over d^dimension, with d at the node. Not finite without nodes.
  double mean, min, max;
  bool of_body;                  // that is larger than the elements
  bool of_wall;                  // and lies around the domain
  std::optional<double> mass{};  // of all nodes, if there is a density
};

// Which cells, and what they are measured by.
struct VolumesWanted {
  int dimension;                // of the elements
  pnpbs_domain body = nullptr;  // that the nodes stand for, if it is larger than the elements
  bool of_wall = false;         // is the body one?
  double bubbles = 1;           // their spacing, over d
  const Density* density = nullptr;
};

// Makes the cells, and adds their volumes as the field "volume" to what files of the placement
// will have, and with a density the fields of that. Returns the figures on the first rank, which
// are the same for any number of ranks; zeros on the others. Collective. Throws Failure.
VolumeFigures add_volumes(pnpbs_placement placement, const VolumesWanted& wanted,
                          pnpbs_context context, const Ranks& ranks);

}  // namespace pnpbs::tool
