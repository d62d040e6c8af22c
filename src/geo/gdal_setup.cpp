// SPDX-License-Identifier: BSD-3-Clause
#include "geo/gdal_setup.hpp"

#include <cpl_conv.h>
#include <dlfcn.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>

namespace pnpbs::geo {
namespace {

std::filesystem::path folder_of_this_library() {
  Dl_info info;
  if (::dladdr(reinterpret_cast<const void*>(&set_up_gdal), &info) == 0) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

void use_data_beside_the_library() {
  const std::filesystem::path folder = folder_of_this_library();
  std::error_code none;
  const std::string gdal = folder / "gdal-data", proj = folder / "proj-data";
  if (std::filesystem::is_directory(gdal, none)) CPLSetConfigOption("GDAL_DATA", gdal.c_str());
  if (!std::filesystem::is_directory(proj, none)) return;
  const char* const paths[] = {proj.c_str(), nullptr};
  OSRSetPROJSearchPaths(paths);
}

}  // namespace

void set_up_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    use_data_beside_the_library();
    GDALAllRegister();
  });
}

}  // namespace pnpbs::geo
