// SPDX-License-Identifier: BSD-3-Clause
// How good the Voronoi cells are for finite volumes, over all ranks: the same bits for any number
// of ranks and threads, as all sums are of integers.
#pragma once

#include <cstdint>

#include "comm/communicator.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "quality/measured_nodes.hpp"

namespace pnpbs {

struct CellQuality {
  // Of moving nodes from the centroids of their cells for the density d^-4, over d.
  double mean_offset = 0, max_offset = 0;
  // Edges between two triangles that the Voronoi edge between their circumcentres does not cross.
  std::int64_t uncrossed = 0;
};

// From stars that are right for the owned nodes, and exact ghosts around these. Collective.
CellQuality measure_cells(const Communicator& comm, const MeasuredNodes<2>& measured,
                          const DelaunayStars& stars);

}  // namespace pnpbs
