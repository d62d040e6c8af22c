// SPDX-License-Identifier: BSD-3-Clause
#include "geo/raster_file.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <string_view>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "geo/gdal_messages.hpp"

namespace pnpbs::geo {
namespace {

constexpr std::int64_t max_values = 200'000'000;

[[noreturn]] void reject_raster(const std::string& message) {
  throw Error(ErrorKind::file, message);
}

// Files of several variables have each as a dataset of its own.
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

// What a band is called: NetCDF's variable, or the description of the band.
std::string name_of(GDALRasterBandH band) {
  const char* variable = GDALGetMetadataItem(band, "NETCDF_VARNAME", nullptr);
  return variable ? variable : GDALGetDescription(band);
}

// By the conventions for climate and forecast an axis in this unit is longitude, and most such
// NetCDF files name no ellipsoid.
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
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
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
    : name_("'" + path + "'"), dataset_(open(path)) {
  if (GDALGetRasterCount(dataset_.get()) == 0)
    open_variable(path, variable);
  else
    choose_band(variable);
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
    reject_raster(name_ + " does not say where its cells lie: it has no geographic reference");
  return affine;
}

ReferenceSystem RasterFile::system() const {
  const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset_.get());
  if (system) return ReferenceSystem::copy_of(system);
  return has_degrees_east(dataset_.get()) ? ReferenceSystem::called("EPSG:4326")
                                          : ReferenceSystem();
}

std::vector<double> RasterFile::read(std::int64_t column, std::int64_t row, std::int64_t columns,
                                     std::int64_t rows) const {
  if (columns > max_values / rows)
    reject_raster(name_ + " has " + std::to_string(columns) + " x " + std::to_string(rows) +
                  " values where the domain is, expected at most " + std::to_string(max_values) +
                  ": make it coarser, with gdalwarp -tr, say");
  std::vector<double> values(static_cast<std::size_t>(columns * rows));
  const GdalMessages messages;
  if (GDALRasterIO(band_, GF_Read, static_cast<int>(column), static_cast<int>(row),
                   static_cast<int>(columns), static_cast<int>(rows), values.data(),
                   static_cast<int>(columns), static_cast<int>(rows), GDT_Float64, 0, 0) != CE_None)
    reject_raster("cannot read " + name_ + ": " + messages.failure());
  int has_no_data = 0, has_scale = 0, has_offset = 0;
  const double no_data = GDALGetRasterNoDataValue(band_, &has_no_data);
  const double scale = GDALGetRasterScale(band_, &has_scale);
  const double offset = GDALGetRasterOffset(band_, &has_offset);
  for (double& value : values) {
    if ((has_no_data && value == no_data) || !std::isfinite(value))
      value = std::numeric_limits<double>::quiet_NaN();
    else
      value = (has_scale ? scale : 1) * value + (has_offset ? offset : 0);
  }
  return values;
}

}  // namespace pnpbs::geo
