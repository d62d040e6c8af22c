// SPDX-License-Identifier: BSD-3-Clause
// What each node stands for: the volumes of Voronoi cells, for files and in figures.
#pragma once

#include <optional>
#include <span>

#include "tool/density.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// Over all nodes, or particles.
struct VolumeFigures {
  int dimension;  // volumes are areas if it is 2
  double total;
  // Of the volume over d^dimension, with d at the node. Not finite without nodes.
  double mean, min, max;
  std::optional<double> mass{};  // of all, if there is a density
};

// Of those of this rank, with these d. Returns the figures on the first rank, which are the same
// for any number of ranks; zeros on the others. Collective.
VolumeFigures volume_figures(int dimension, std::span<const double> volumes,
                             std::span<const double> spacing, const Ranks& ranks);

// Makes the Voronoi cells of the nodes, and adds their volumes as the field "volume" to what files
// of the placement will have, and with a density the fields of that. dimension: of the elements.
// Figures as above. Collective. Throws Failure.
VolumeFigures add_volumes(pnpbs_placement placement, int dimension,
                          const std::optional<Density>& density, pnpbs_context context,
                          const Ranks& ranks);

}  // namespace pnpbs::tool
