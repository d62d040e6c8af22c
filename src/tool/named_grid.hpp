// SPDX-License-Identifier: BSD-3-Clause
// A grid given by --spacing-grid NAME=FILE:VARIABLE for use in formulas. ESRI ASCII grids are read
// here. GDAL reads other formats and projects them like the domain.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "tool/geo_file.hpp"

namespace pnpbs::tool {

// Spacing sampled on a grid, read from an ESRI ASCII grid (.asc), which every GIS writes:
//
//   ncols 4          xllcenter 0      cellsize 0.5          1 1 2 2   (northern row first)
//   nrows 3          yllcenter 0      nodata_value -9999    1 1 1 2 ...
//
// Cells that are not squares have dx and dy instead of cellsize. Bodies may have layers: one such
// block of values per layer, the lowest first, and nlayers, zllcorner or zllcenter, and dz beside
// dx and dy in the header.
struct Grid {
  std::int64_t size[3] = {1, 1, 1};  // grid points in x, y and z
  double origin[3] = {0, 0, 0};      // the lowest south-western grid point
  double step[3] = {1, 1, 1};        // distance of columns, rows and layers
  std::vector<double> values;        // x fastest, from the south, from below
  std::vector<bool> has_data;        // whether the file has each value; empty if it has all
};

// Reads an ESRI ASCII grid. Cells without data take the value of the nearest cell with data,
// counted in steps along rows, columns and layers. Values of a grid without layers apply to all
// heights. A grid with layers requires dimension 3. Throws BadInput with file, line and what was
// expected.
Grid read_grid(const std::string& path, int dimension);

// Throws BadInput with the file, row, column and position of the first value that cannot be d: one
// that is zero, negative or not finite.
void require_spacings(const Grid& grid, const std::string& path, int dimension);

// Interpolates the values linearly in each direction, and extends them as constants beyond the
// border, as pnpbs_placement_set_spacing_grid does. In two dimensions the lowest layer is used.
double value_at(const Grid& grid, const double* place, int dimension);
// Returns whether the file has any of the values that the interpolation at this point uses.
bool has_data_around(const Grid& grid, const double* place, int dimension);

class NamedGrid {
 public:
  // `text` is NAME=FILE:VARIABLE. Without NAME the grid is called `other_name`. Reads the file
  // unless GDAL is required. On a sphere the values are at longitudes and latitudes. Throws
  // BadInput.
  NamedGrid(const std::string& text, int dimension, bool on_sphere,
            const std::string& option = "--spacing-grid", const std::string& other_name = "grid");
  ~NamedGrid();
  NamedGrid(const NamedGrid&) = delete;
  NamedGrid& operator=(const NamedGrid&) = delete;

  const std::string& name() const { return name_; }
  const std::string& path() const { return path_; }
  // Returns nullptr if GDAL reads the grid.
  const Grid* text_grid() const { return text_.get(); }

  // Reads the part of the grid that covers the domain, if GDAL reads it. Must be called before
  // evaluate(). `projection` is that of the domain, or "" if unknown. Throws Failure, also if the
  // grid does not overlap the domain.
  void open(const std::string& projection, const Box<3>& domain);
  // Values of inside[i], unless `inside` is nullptr, as in pnpbs_geo_grid_values: a point lies more
  // than half a cell beyond the edge of the grid, within the grid, or where no surrounding cell has
  // data.
  static constexpr std::int32_t beyond_edge = 0, within = 1, without_data = 2;
  void evaluate(std::int64_t n, const double* coordinates, double* values,
                std::int32_t* inside) const;
  Box<3> extent() const;

 private:
  void evaluate_in_plane(std::int64_t n, const double* coordinates, double* values,
                         std::int32_t* inside) const;
  void evaluate_text(std::int64_t n, const double* coordinates, double* values,
                     std::int32_t* inside) const;
  void check(pnpbs_status status) const;

  int dimension_;  // number of coordinates of a point
  bool on_sphere_;
  std::string option_, name_, path_, variable_;
  std::unique_ptr<Grid> text_;
  std::unique_ptr<GeoLibrary> library_;
  pnpbs_geo_grid grid_ = nullptr;
};

// Returns the file name in such a text.
std::string path_of_grid(const std::string& text);

}  // namespace pnpbs::tool
