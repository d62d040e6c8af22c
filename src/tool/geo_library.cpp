// SPDX-License-Identifier: BSD-3-Clause
#include "tool/geo_library.hpp"

#include <dlfcn.h>

#include <string>

#include "base/build_config.hpp"
#include "tool/exit.hpp"

namespace pnpbs::tool {
namespace {

// Never closed: GDAL leaves behind what runs at the end of the process.
void* open_library() {
  void* const handle = ::dlopen(PNPBS_GEO_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  if (handle) return handle;
  const char* reason = ::dlerror();
  throw Failure(ExitCode::failed,
                std::string("GeoJSON, shapefiles, GeoTIFF, NetCDF and the like are read by GDAL, "
                            "and the library that calls it cannot be opened (") +
                    (reason ? reason : PNPBS_GEO_LIBRARY) +
                    "). Install GDAL (Debian: libgdal-dev), configure PNPBS again "
                    "(PNPBS_ENABLE_GEO) and build it.");
}

template <class Function>
void find(void* library, Function& function, const char* name) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (!function)
    throw Failure(ExitCode::failed, std::string(PNPBS_GEO_LIBRARY) + " has no " + name +
                                        ": it is older than this command");
}

}  // namespace

GeoLibrary::GeoLibrary() {
  void* const library = open_library();
  find(library, last_error, "pnpbs_geo_last_error");
  find(library, read, "pnpbs_geo_read");
  find(library, destroy, "pnpbs_geo_destroy");
  find(library, add_to_domain, "pnpbs_geo_add_to_domain");
  find(library, explain, "pnpbs_geo_explain");
  find(library, projection, "pnpbs_geo_projection");
  find(library, scale, "pnpbs_geo_scale");
  find(library, note_count, "pnpbs_geo_note_count");
  find(library, get_note, "pnpbs_geo_get_note");
  find(library, get_note_data, "pnpbs_geo_get_note_data");
  find(library, grid_read, "pnpbs_geo_grid_read");
  find(library, grid_destroy, "pnpbs_geo_grid_destroy");
  find(library, grid_values, "pnpbs_geo_grid_values");
  find(library, grid_extent, "pnpbs_geo_grid_extent");
}

}  // namespace pnpbs::tool
