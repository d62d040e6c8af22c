// SPDX-License-Identifier: BSD-3-Clause
// A grid that the user names, --spacing-grid NAME=FILE:VARIABLE, for use in formulas: read here if
// it is an ESRI ASCII grid, by GDAL otherwise, which projects it as the domain is.
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
// Cells that are no squares have dx and dy instead of cellsize. For bodies there may be layers, one
// such block of values after the other, the lowest first: nlayers, zllcorner or zllcenter, and dz
// beside dx and dy.
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

class NamedGrid {
 public:
  // "FILE" has the other name. Reads what needs no GDAL. Throws BadInput.
  // On a sphere its values are at longitudes and latitudes.
  NamedGrid(const std::string& text, int dimension, bool on_sphere,
            const std::string& option = "--spacing-grid", const std::string& other_name = "grid");
  ~NamedGrid();
  NamedGrid(const NamedGrid&) = delete;
  NamedGrid& operator=(const NamedGrid&) = delete;

  const std::string& name() const { return name_; }
  const std::string& path() const { return path_; }
  // nullptr if GDAL reads it.
  const Grid* text_grid() const { return text_.get(); }

  // Before its values are asked for: reads what GDAL reads, where the domain is. The projection of
  // the domain is "" if that is not known. Throws Failure, also if the grid lies beside the domain.
  void open(const std::string& projection, const Box<3>& domain);
  // What inside[i] says of a point, unless it is nullptr, as pnpbs_geo_grid_values has it: it lies
  // more than half a cell beyond the grid's edge, or where no cell around it has data, or neither.
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

  int dimension_;  // of its places
  bool on_sphere_;
  std::string option_, name_, path_, variable_;
  std::unique_ptr<Grid> text_;
  std::unique_ptr<GeoLibrary> library_;
  pnpbs_geo_grid grid_ = nullptr;
};

// The file in such a text.
std::string path_of_grid(const std::string& text);

}  // namespace pnpbs::tool
