// SPDX-License-Identifier: BSD-3-Clause
// Grids of the Model for Prediction Across Scales: the Voronoi cells of nodes on a sphere.
#pragma once

#include "cgrid/sphere_grid.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// In NetCDF's 64-bit data format, with all that MPAS reads (MPAS mesh specification 1.0,
// mpas-dev.github.io, and mesh quality as its converter writes it). Collective.
void write_mpas(const SphereGrid& grid, SharedFile& file);

// The graph of the cells, for gpmetis: graph.info. Collective.
void write_cell_graph(const SphereGrid& grid, SharedFile& file);

}  // namespace pnpbs::io
