// SPDX-License-Identifier: BSD-3-Clause
// Spacing sampled on a grid, read from an ESRI ASCII grid (.asc), which every GIS writes:
//
//   ncols 4          xllcenter 0      cellsize 0.5          1 1 2 2   (northern row first)
//   nrows 3          yllcenter 0      nodata_value -9999    1 1 1 2 ...
//
// Cells that are no squares have dx and dy instead of cellsize.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pnpbs::tool {

struct Grid {
  std::int64_t size[2];        // grid points in x and y
  double origin[2];            // the south-western one
  double step[2];              // of columns and rows
  std::vector<double> values;  // x fastest, from the south
};

// Throws BadInput with file, line and what was expected. Cells without data take the value of
// the nearest cell that has one, in steps along rows and columns.
Grid read_grid(const std::string& path);

}  // namespace pnpbs::tool
