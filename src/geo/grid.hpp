// SPDX-License-Identifier: BSD-3-Clause
// Values on a grid in a file that GDAL reads (GeoTIFF, NetCDF and others), asked for at points of
// another projection: each is projected into the grid's own system, and values are linear in each
// direction between the middles of its cells. They are read where they are asked for.
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

struct GridRequest {
  std::string path;
  std::string variable;    // "" if there is only one
  std::string projection;  // of the points: as ReferenceSystem::called has it; "": the grid's own
  Box<2> part;             // of the points' plane, that is read
};

class Grid {
 public:
  // Throws Error, of kind spacing where the grid has nothing in the part.
  explicit Grid(const GridRequest& request);

  // Constant beyond the grid's edge, and there inside[i] is 0; cells without data have the value of
  // the nearest cell that has some, and inside[i] is 2 where all around the point are such, else 1.
  // Throws Error where a point has no place in the grid's system, or the file can no longer be
  // read. Of several threads one at a time.
  void evaluate(const std::vector<Point<2>>& points, double* values, std::int32_t* inside) const;
  const Box<2>& extent() const { return extent_; }  // around all of it, in the points' plane

 private:
  // Columns and rows as fractions, the middle of the first cell at 0.
  std::vector<Point<2>> cells_of(std::vector<Point<2>> points) const;
  void choose_system(const GridRequest& request, const ReferenceSystem& system);
  void measure_extent();
  CellBox window_for(const GridRequest& request) const;

  std::string name_;
  std::int64_t columns_ = 0, rows_ = 0;
  std::array<double, 6> to_plane_{}, to_cells_{};     // GDAL's affine transformations
  std::optional<Transformation> forward_, backward_;  // from the points' plane to the grid's
  bool wraps_ = false;  // the grid is in degrees, its longitudes may be any of those 360 apart
  bool goes_around_ = false;  // its last column is beside the first one
  Box<2> extent_{};
  CellBox window_{};
  RasterFile file_;
  std::unique_ptr<RasterValues> values_;  // of the window
  mutable std::mutex one_at_a_time_;
};

// How steep the values on a grid are: their change per unit of the points' coordinates, or, where
// the radius is not 0, per length along the sphere on which points have these degrees.
void evaluate_slopes(const Grid& grid, double radius, const std::vector<Point<2>>& points,
                     double* slopes);

}  // namespace pnpbs::geo
