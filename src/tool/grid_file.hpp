// SPDX-License-Identifier: BSD-3-Clause
// Spacing sampled on a grid, read from an ESRI ASCII grid (.asc), which every GIS writes:
//
//   ncols 4          xllcenter 0      cellsize 0.5          1 1 2 2   (northern row first)
//   nrows 3          yllcenter 0      nodata_value -9999    1 1 1 2 ...
//
// Cells that are no squares have dx and dy instead of cellsize. For bodies there may be layers, one
// such block of values after the other, the lowest first: nlayers, zllcorner or zllcenter, and dz
// beside dx and dy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pnpbs::tool {

struct Grid {
  std::int64_t size[3] = {1, 1, 1};  // grid points in x, y and z
  double origin[3] = {0, 0, 0};      // the lowest south-western one
  double step[3] = {1, 1, 1};        // of columns, rows and layers
  std::vector<double> values;        // x fastest, from the south, from below
  std::vector<bool> has_data;        // of each value: is it in the file? Empty if all are
};

// Throws BadInput with file, line and what was expected. Cells without data take the value of
// the nearest cell that has one, in steps along rows, columns and layers. Without layers, the
// values are those of all heights; with layers, dimension must be 3.
Grid read_grid(const std::string& path, int dimension);

// Between the grid's points: linear in each direction, constant beyond the border, as
// pnpbs_placement_set_spacing_grid has it. Of two dimensions: in the lowest layer.
double value_at(const Grid& grid, const double* place, int dimension);
// Is any value that it is made of in the file?
bool has_data_around(const Grid& grid, const double* place, int dimension);

}  // namespace pnpbs::tool
