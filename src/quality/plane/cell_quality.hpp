// SPDX-License-Identifier: BSD-3-Clause
// Quality of the Voronoi cells for finite volumes, over all ranks. All sums are sums of integers,
// so the results have the same bits for any number of ranks and threads.
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

// Statistics of one figure over cells or over edges between cells.
struct CellFigure {
  std::int64_t number = 0;  // number of cells or edges; if it is 0, the others are 0
  double mean = 0, worst = 0;
};

// Shape of the cells of moving nodes (quality/plane/voronoi_ring.hpp), measured along the sphere if
// there is one.
struct CellShape {
  CellFigure edge_ratio;  // shortest edge of a cell over its longest
  // Area of the smaller over that of the larger of two adjacent cells.
  CellFigure area_ratio;
  // Distance between the middle of a Voronoi edge and the middle of its Delaunay edge, over the
  // length of the latter: the skewness of finite volumes, as on the C-grids of H. Weller, J.
  // Thuburn and C. Cotter, Monthly Weather Review 140 (2012), 2734-2755. R. Heikes and D. Randall,
  // Monthly Weather Review 123 (1995), 1881-1887, divide by the length of the Voronoi edge, which
  // is 0 for four nodes on a circle.
  CellFigure dual_offset;
};

// Shape of the cells in one band of d. A cell belongs to the band of d at its node, an edge to that
// of the mean d of its nodes.
struct CellBand {
  double from = 0, to = 0;  // [d]
  CellShape shape;
};

// Everything that measure_cells() computes.
struct CellQuality {
  // Distance of moving nodes from the centroids of their cells for the density d^-4. [d]
  double mean_offset = 0, max_offset = 0;
  // Number of edges between two triangles whose circumcentres lie on the same side of the edge.
  std::int64_t uncrossed = 0;
  CellShape shape;
  std::vector<CellBand> bands;  // only bands with a cell or an edge
};

// Overwrites the values at ghosts by those of their owners. `values` has one entry per node of this
// rank. Collective.
using FillGhosts = std::function<void(const View<double>& values)>;

// Measures the cells of all ranks. The stars must be valid for the owned nodes and the ghosts
// around these exact.
// Collective.
CellQuality measure_cells(const Communicator& comm, const MeasuredNodes<2>& measured,
                          const DelaunayStars& stars, const SpacingBands& bands,
                          const FillGhosts& fill_ghosts);

}  // namespace pnpbs
