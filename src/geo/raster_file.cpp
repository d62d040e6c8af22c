// SPDX-License-Identifier: BSD-3-Clause
#include "geo/raster_file.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "geo/gdal_messages.hpp"
#include "geo/gdal_setup.hpp"

namespace pnpbs::geo {
namespace {

// Limit of GDAL's cache for this file, unless the user has set GDAL's limit. GDAL's own default is
// 5 % of the machine's memory.
constexpr std::int64_t max_bytes_in_gdal = std::int64_t{64} << 20;

[[noreturn]] void reject_raster(const std::string& message) {
  throw Error(ErrorKind::file, message);
}

// A variable of a file with several. GDAL opens it as a dataset of its own.
struct Variable {
  std::string name, path;
};

std::vector<Variable> variables_of(GDALDatasetH dataset) {
  std::vector<Variable> variables;
  char** const list = GDALGetMetadata(dataset, "SUBDATASETS");
  for (int k = 1;; ++k) {
    const std::string key = "SUBDATASET_" + std::to_string(k) + "_NAME";
    const char* path = CSLFetchNameValue(list, key.c_str());
    if (!path) return variables;
    const std::string text = path;
    std::string name = text.substr(text.find_last_of(":/") + 1);
    variables.push_back({name, text});
  }
}

std::string names_of(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& variable : variables) names.push_back(variable.name);
  return list_text(names, 20);
}

// Returns the name of the NetCDF variable, or the description of the band.
std::string name_of(GDALRasterBandH band) {
  const char* variable = GDALGetMetadataItem(band, "NETCDF_VARNAME", nullptr);
  return variable ? variable : GDALGetDescription(band);
}

// Returns whether an axis has a unit of longitude by the conventions for climate and forecast (CF).
// Most such NetCDF files name no ellipsoid.
bool has_degrees_east(GDALDatasetH dataset) {
  constexpr std::string_view units[] = {"#units=degrees_east", "#units=degree_east",
                                        "#units=degreesE", "#units=degrees_E"};
  char** const list = GDALGetMetadata(dataset, nullptr);
  for (int k = 0; k < CSLCount(list); ++k)
    for (const std::string_view unit : units)
      if (std::string_view(list[k]).ends_with(unit)) return true;
  return false;
}

}  // namespace

RasterFile::Dataset RasterFile::open(const std::string& path) {
  set_up_gdal();
  VSIStatBufL status;
  if (VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) != 0 &&
      path.find(':') == std::string::npos)
    reject_raster("cannot open '" + path + "': there is no such file");
  const GdalMessages messages;
  Dataset dataset(GDALOpenEx(path.c_str(),
                             GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr,
                             nullptr, nullptr));
  if (!dataset) reject_raster("cannot read '" + path + "': " + messages.failure());
  return dataset;
}

RasterFile::RasterFile(const std::string& path, const std::string& variable)
    : path_(path), variable_(variable) {
  open_band();
}

void RasterFile::open_band() {
  name_ = "'" + path_ + "'";
  band_ = nullptr;
  dataset_ = open(path_);
  if (GDALGetRasterCount(dataset_.get()) == 0)
    open_variable(path_, variable_);
  else
    choose_band(variable_);
  process_ = ::getpid();
}

void RasterFile::open_variable(const std::string& path, const std::string& variable) {
  const std::vector<Variable> variables = variables_of(dataset_.get());
  if (variables.empty()) reject_raster(name_ + " has no values on a grid");
  if (variable.empty())
    reject_raster(name_ + " has " + std::to_string(variables.size()) +
                  " variables, so the one to read must be named (" + path +
                  ":NAME): " + names_of(variables));
  for (const Variable& each : variables) {
    if (each.name != variable) continue;
    dataset_ = open(each.path);
    name_ += ", variable '" + variable + "'";
    choose_band("");
    return;
  }
  reject_raster(name_ + " has no variable '" + variable + "'; it has: " + names_of(variables));
}

void RasterFile::choose_band(const std::string& variable) {
  const int count = GDALGetRasterCount(dataset_.get());
  if (variable.empty() && count != 1)
    reject_raster(name_ + " has " + std::to_string(count) +
                  " bands: name one by its number, as in FILE:1");
  std::vector<Variable> bands;
  for (int k = 1; k <= count; ++k) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset_.get(), k);
    const std::string name = name_of(band);
    bands.push_back({name.empty() ? std::to_string(k) : name, ""});
    if (!variable.empty() && variable != name && variable != std::to_string(k)) continue;
    if (!band_) band_ = band;
  }
  if (!band_) reject_raster(name_ + " has no band '" + variable + "'; it has: " + names_of(bands));
}

std::int64_t RasterFile::columns() const { return GDALGetRasterXSize(dataset_.get()); }
std::int64_t RasterFile::rows() const { return GDALGetRasterYSize(dataset_.get()); }

std::array<double, 6> RasterFile::to_plane() const {
  std::array<double, 6> affine{};
  if (GDALGetGeoTransform(dataset_.get(), affine.data()) != CE_None)
    reject_raster(name_ +
                  " has no geographic reference, so the positions of its cells are not known");
  return affine;
}

ReferenceSystem RasterFile::system() const {
  const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset_.get());
  if (system) return ReferenceSystem::copy_of(system);
  return has_degrees_east(dataset_.get()) ? ReferenceSystem::called("EPSG:4326")
                                          : ReferenceSystem();
}

// Blocks of a file are tiles or some rows. Small tiles and short rows are read together; large
// blocks are read in parts.
std::array<std::int64_t, 2> RasterFile::shape_of_blocks() const {
  constexpr std::int64_t side = 512, many = std::int64_t{1} << 19, too_many = std::int64_t{1} << 22;
  int columns = 0, rows = 0;
  GDALGetBlockSize(band_, &columns, &rows);
  const std::int64_t across = std::clamp<std::int64_t>(columns, 1, this->columns()),
                     down = std::clamp<std::int64_t>(rows, 1, this->rows());
  if (across * down > too_many) return {side, side};
  const std::int64_t width = across * std::max<std::int64_t>(1, side / across);
  return {width, down * std::max<std::int64_t>(1, many / (width * down))};
}

NumberConversion RasterFile::meaning() const {
  NumberConversion meaning;
  int has_no_data = 0, has_scale = 0, has_offset = 0;
  meaning.no_data = GDALGetRasterNoDataValue(band_, &has_no_data);
  meaning.has_no_data = has_no_data != 0;
  const double scale = GDALGetRasterScale(band_, &has_scale);
  const double offset = GDALGetRasterOffset(band_, &has_offset);
  if (has_scale) meaning.scale = scale;
  if (has_offset) meaning.offset = offset;
  return meaning;
}

void RasterFile::read_numbers(const CellBox& cells, void* numbers, GDALDataType type) const {
  const auto column = static_cast<int>(cells.column), row = static_cast<int>(cells.row),
             columns = static_cast<int>(cells.columns), rows = static_cast<int>(cells.rows);
  const GdalMessages messages;
  if (GDALRasterIO(band_, GF_Read, column, row, columns, rows, numbers, columns, rows, type, 0,
                   0) != CE_None)
    reject_raster("cannot read " + name_ + ": " + messages.failure());
}

// Drops the blocks of this file from GDAL's cache when they may exceed our limit. The cache is
// common to the process, so its own limit is not changed.
void RasterFile::limit_cache_of_gdal(const CellBox& read) {
  if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr)) return;
  int columns = 1, rows = 1;
  GDALGetBlockSize(band_, &columns, &rows);
  const Tiling blocks({0, 0, this->columns(), this->rows()}, columns, rows);
  std::int64_t count = 0;
  blocks.for_each_in(read, [&](auto...) { ++count; });
  bytes_in_gdal_ += count * columns * rows * GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band_));
  if (bytes_in_gdal_ < max_bytes_in_gdal) return;
  GDALFlushRasterCache(band_);
  bytes_in_gdal_ = 0;
}

RasterBlock RasterFile::read(const CellBox& cells) {
  // A forked process shares the file offset with its parent, so it must open the file again.
  if (::getpid() != process_) {
    static_cast<void>(dataset_.release());
    open_band();
  }
  const auto is_part_of = [type = GDALGetRasterDataType(band_)](GDALDataType wider) {
    return GDALDataTypeUnion(type, wider) == wider;
  };
  const auto numbers_of = [&](auto number, GDALDataType type) {
    std::vector<decltype(number)> numbers(static_cast<std::size_t>(cells.count()));
    read_numbers(cells, numbers.data(), type);
    return RasterBlock::Numbers(std::move(numbers));
  };
  RasterBlock::Numbers numbers = is_part_of(GDT_Int16)     ? numbers_of(std::int16_t{}, GDT_Int16)
                                 : is_part_of(GDT_Float32) ? numbers_of(float{}, GDT_Float32)
                                                           : numbers_of(double{}, GDT_Float64);
  limit_cache_of_gdal(cells);
  return {cells, std::move(numbers), meaning()};
}

}  // namespace pnpbs::geo
