// SPDX-License-Identifier: BSD-3-Clause
// The volume of each particle, which is that of its Voronoi cell within the body.
#pragma once

#include <span>
#include <vector>

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"
#include "shape/signed_distance.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace pnpbs {

// Returns the volumes of the owned particles; 0 for those left out.
// `cells` are those of the nodes at their original positions `first`. A volume is computed again
// (CellInBody) if the cell ends at the boundary of the elements, or if a node near it has moved or
// is left out. These volumes are multiplied by a common factor, so that all sum up to `measure`,
// that of the body. Throws Error(ErrorKind::domain) if the factor is far from 1. Collective. If one
// rank throws, all ranks throw.
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
