// SPDX-License-Identifier: BSD-3-Clause
// Values on a grid in a file that GDAL reads (GeoTIFF, NetCDF and others), evaluated at points in
// another projection. Each point is projected into the grid's reference system. Values are bilinear
// between the centres of cells. Only the parts of the file that are needed are read.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "geo/raster_file.hpp"
#include "geo/raster_values.hpp"
#include "geo/reference_system.hpp"

namespace pnpbs::geo {

// The grid to read.
struct GridRequest {
  std::string path;
  std::string variable;  // "": the file has only one variable
  // Projection of the points, see ReferenceSystem::called(); "": that of the grid.
  std::string projection;
  Box<2> part;  // region of interest in the projection of the points
};

// A grid that stays open and evaluates its values at points.
class Grid {
 public:
  // Opens the file. Throws Error, of kind spacing if the grid has no data in the part.
  explicit Grid(const GridRequest& request);

  // Evaluates the grid at points. Beyond its edge the values are constant. A cell without data
  // takes the value of the nearest cell with data. inside[i] is 0 beyond the edge, 2 if no cell
  // around the point has data, else 1; `inside` may be null. Thread-safe, one thread at a time.
  // Throws Error if a point cannot be projected into the grid's system or the file can no longer be
  // read.
  void evaluate(const std::vector<Point<2>>& points, double* values, std::int32_t* inside) const;
  // Returns the bounding box of the grid in the projection of the points.
  const Box<2>& extent() const { return extent_; }

 private:
  // Returns fractional columns and rows, with the centre of the first cell at 0.
  std::vector<Point<2>> cells_of(std::vector<Point<2>> points) const;
  void choose_system(const GridRequest& request, const ReferenceSystem& system);
  void measure_extent();
  CellBox window_for(const GridRequest& request) const;

  std::string name_;
  std::int64_t columns_ = 0, rows_ = 0;
  // GDAL's affine transformations from cells to coordinates and back
  std::array<double, 6> to_plane_{}, to_cells_{};
  // From the points' projection to the grid's system, and back.
  std::optional<Transformation> forward_, backward_;
  bool wraps_ = false;        // the grid is in degrees, so longitudes are equivalent modulo 360
  bool goes_around_ = false;  // the last column is adjacent to the first one
  Box<2> extent_{};
  CellBox window_{};
  RasterFile file_;
  std::unique_ptr<RasterValues> values_;  // values in the window
  mutable std::mutex one_at_a_time_;
};

// Computes the slope of the grid's values: the norm of their gradient, per unit of the points'
// coordinates. If `radius` is not 0, points are in degrees and slopes are per length along the
// sphere of this radius.
void evaluate_slopes(const Grid& grid, double radius, const std::vector<Point<2>>& points,
                     double* slopes);

}  // namespace pnpbs::geo
