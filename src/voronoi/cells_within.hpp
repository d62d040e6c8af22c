// SPDX-License-Identifier: BSD-3-Clause
// Volumes of Voronoi cells within a body that is larger than the elements: nodes that lie half a
// spacing off its wall stand for what is between them and the wall, too.
#pragma once

#include <span>

#include "voronoi/elements_of_sites.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace pnpbs {

// Gives each cell that has a share of the boundary of the elements its volume within the body
// (CellInBody), times the one factor with which all volumes add up to the body's. d: of the nodes.
// Throws Error(ErrorKind::domain) if a node is not strictly inside, or if that factor is far from
// 1. Collective.
template <int Dim>
void extend_to_wall(const Communicator& comm, const ElementSites<Dim>& all,
                    const ElementsOfSites<Dim>& at_nodes, const Domain<Dim>& body,
                    std::span<const double> d, VoronoiCells& cells);

extern template void extend_to_wall(const Communicator&, const ElementSites<2>&,
                                    const ElementsOfSites<2>&, const PlaneDomain&,
                                    std::span<const double>, VoronoiCells&);
extern template void extend_to_wall(const Communicator&, const ElementSites<3>&,
                                    const ElementsOfSites<3>&, const VolumeDomain&,
                                    std::span<const double>, VoronoiCells&);

}  // namespace pnpbs
