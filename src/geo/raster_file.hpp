// SPDX-License-Identifier: BSD-3-Clause
// One band of a raster file, as GDAL reads it.
#pragma once

#include <gdal.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "geo/reference_system.hpp"

namespace pnpbs::geo {

class RasterFile {
 public:
  // The variable is the name of one in a file of several (NetCDF, HDF5), or the number or the
  // description of a band; "" if there is only one. Throws Error.
  RasterFile(const std::string& path, const std::string& variable);

  const std::string& name() const { return name_; }
  std::int64_t columns() const;
  std::int64_t rows() const;
  std::array<double, 6> to_plane() const;  // GDAL's. Throws Error if there is none
  ReferenceSystem system() const;          // none if the file names none
  // Without data: not a number. Row by row, from the first of the file on. Throws Error.
  std::vector<double> read(std::int64_t column, std::int64_t row, std::int64_t columns,
                           std::int64_t rows) const;

 private:
  struct Close {
    void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
  };
  using Dataset = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, Close>;

  static Dataset open(const std::string& path);
  void open_variable(const std::string& path, const std::string& variable);
  void choose_band(const std::string& variable);

  std::string name_;  // for messages
  Dataset dataset_;
  GDALRasterBandH band_ = nullptr;
};

}  // namespace pnpbs::geo
