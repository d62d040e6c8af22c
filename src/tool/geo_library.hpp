// SPDX-License-Identifier: BSD-3-Clause
// libpnpbs_geo, opened when a file for GDAL is named and not before: with the hundred libraries
// behind GDAL, every start would take a tenth of a second longer.
#pragma once

#include "pnpbs/pnpbs_geo.h"

namespace pnpbs::tool {

// The functions of the library, by their names.
struct GeoLibrary {
  GeoLibrary();  // throws Failure where it cannot be opened

#define PNPBS_TOOL_FUNCTION(name) decltype(&pnpbs_geo_##name) name
  PNPBS_TOOL_FUNCTION(last_error);
  PNPBS_TOOL_FUNCTION(read);
  PNPBS_TOOL_FUNCTION(destroy);
  PNPBS_TOOL_FUNCTION(add_to_domain);
  PNPBS_TOOL_FUNCTION(explain);
  PNPBS_TOOL_FUNCTION(projection);
  PNPBS_TOOL_FUNCTION(scale);
  PNPBS_TOOL_FUNCTION(note_count);
  PNPBS_TOOL_FUNCTION(get_note);
  PNPBS_TOOL_FUNCTION(get_note_data);
  PNPBS_TOOL_FUNCTION(grid_read);
  PNPBS_TOOL_FUNCTION(grid_destroy);
  PNPBS_TOOL_FUNCTION(grid_values);
  PNPBS_TOOL_FUNCTION(grid_extent);
#undef PNPBS_TOOL_FUNCTION
};

}  // namespace pnpbs::tool
