// SPDX-License-Identifier: BSD-3-Clause
// What each particle stands for: its Voronoi cell within the body.
#pragma once

#include <span>
#include <vector>

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"
#include "shape/signed_distance.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace pnpbs {

// Of the owned particles; 0 of those left out. `cells` are those of the nodes as they were placed,
// at `first`. Where one ends at the boundary of the elements, or near a node that has moved or is
// left out, its volume is found again (CellInBody); those that were, times one factor, make all
// volumes add up to `measure`, the body's. Throws Error(ErrorKind::domain) if that factor is far
// from 1. Collective, and agreed.
template <int Dim>
std::vector<double> volumes_within(const Communicator& comm, const SignedDistance<Dim>& body,
                                   double measure, const VoronoiCells& cells,
                                   std::span<const Point<Dim>> first,
                                   const KnownParticles<Dim>& particles);

extern template std::vector<double> volumes_within<2>(const Communicator&, const SignedDistance<2>&,
                                                      double, const VoronoiCells&,
                                                      std::span<const Point<2>>,
                                                      const KnownParticles<2>&);
extern template std::vector<double> volumes_within<3>(const Communicator&, const SignedDistance<3>&,
                                                      double, const VoronoiCells&,
                                                      std::span<const Point<3>>,
                                                      const KnownParticles<3>&);

}  // namespace pnpbs
