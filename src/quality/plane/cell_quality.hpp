// SPDX-License-Identifier: BSD-3-Clause
// How good the Voronoi cells are for finite volumes, over all ranks: the same bits for any number
// of ranks and threads, as all sums are of integers.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/execution.hpp"
#include "comm/communicator.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "quality/measured_nodes.hpp"
#include "spacing/spacing_range.hpp"

namespace pnpbs {

struct CellFigure {
  std::int64_t number = 0;  // of cells, or of edges between two; without any the others are 0
  double mean = 0, worst = 0;
};

// Of the cells of moving nodes (quality/plane/voronoi_ring.hpp), along the sphere if on one.
struct CellShape {
  CellFigure edge_ratio;  // of a cell: its shortest edge over its longest
  // Of an edge between two cells: the area of the smaller one over that of the larger.
  CellFigure area_ratio;
  // The same: how far the middle of the Voronoi edge is from that of the nodes' edge, over the
  // length of this: the skewness of finite volumes, as on the C-grids of H. Weller, J. Thuburn and
  // C. Cotter, Monthly Weather Review 140 (2012), 2734-2755. R. Heikes and D. Randall, Monthly
  // Weather Review 123 (1995), 1881-1887, divide by the length of the Voronoi edge, but that may be
  // 0: four nodes on a circle have such an edge.
  CellFigure dual_offset;
};

// Of the cells with d at the node, and the edges with the mean of d at both, in a band.
struct CellBand {
  double from = 0, to = 0;  // of d
  CellShape shape;
};

struct CellQuality {
  // Of moving nodes from the centroids of their cells for the density d^-4, over d.
  double mean_offset = 0, max_offset = 0;
  // Edges between two triangles that the Voronoi edge between their circumcentres does not cross.
  std::int64_t uncrossed = 0;
  CellShape shape;
  std::vector<CellBand> bands;  // with a cell or an edge
};

// Values at nodes of this rank: those at ghosts become those of their owners. Collective.
using FillGhosts = std::function<void(const View<double>& values)>;

// From stars that are right for the owned nodes, and exact ghosts around these. Collective.
CellQuality measure_cells(const Communicator& comm, const MeasuredNodes<2>& measured,
                          const DelaunayStars& stars, const SpacingBands& bands,
                          const FillGhosts& fill_ghosts);

}  // namespace pnpbs
