// SPDX-License-Identifier: BSD-3-Clause
// A band of a raster file, read by GDAL.
#pragma once

#include <gdal.h>
#include <sys/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "geo/raster_block.hpp"
#include "geo/reference_system.hpp"

namespace pnpbs::geo {

// An open raster file.
class RasterFile {
 public:
  // Opens a file. `variable` is a variable of a file with several (NetCDF, HDF5), or the number or
  // description of a band; "" if there is only one. Throws Error.
  RasterFile(const std::string& path, const std::string& variable);

  const std::string& name() const { return name_; }
  std::int64_t columns() const;
  std::int64_t rows() const;
  // Returns GDAL's affine transformation from columns and rows to coordinates. Throws Error if
  // there is none.
  std::array<double, 6> to_plane() const;
  ReferenceSystem system() const;  // empty if the file names none
  // Returns the number of columns and rows of blocks that cost little more to read than a part of
  // them.
  std::array<std::int64_t, 2> shape_of_blocks() const;
  // Reads a rectangle of cells. Throws Error.
  RasterBlock read(const CellBox& cells);

 private:
  struct Close {
    void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
  };
  using Dataset = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, Close>;

  static Dataset open(const std::string& path);
  void open_band();
  void open_variable(const std::string& path, const std::string& variable);
  void choose_band(const std::string& variable);
  NumberConversion meaning() const;
  void read_numbers(const CellBox& cells, void* numbers, GDALDataType type) const;
  void limit_cache_of_gdal(const CellBox& read);

  std::string path_, variable_;
  std::string name_;  // name in messages
  pid_t process_ = 0;
  Dataset dataset_;
  GDALRasterBandH band_ = nullptr;
  std::int64_t bytes_in_gdal_ = 0;  // upper bound of this file's blocks in GDAL's cache
};

}  // namespace pnpbs::geo
