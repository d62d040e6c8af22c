// SPDX-License-Identifier: BSD-3-Clause
// Domains in geographic files (GeoJSON, shapefiles and other formats of GDAL), read by
// libpnpbs_geo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pnpbs/pnpbs_geo.h"
#include "tool/arguments.hpp"

namespace pnpbs::tool {

// libpnpbs_geo, opened only when a file for GDAL is named: loading GDAL and its hundred libraries
// would delay every start by a tenth of a second. Members have the names of its functions.
struct GeoLibrary {
  GeoLibrary();  // throws Failure if the library cannot be opened

#define PNPBS_TOOL_FUNCTION(name) decltype(&pnpbs_geo_##name) name
  PNPBS_TOOL_FUNCTION(build_info);
  PNPBS_TOOL_FUNCTION(last_error);
  PNPBS_TOOL_FUNCTION(read_regions);
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

class GeoFile {
 public:
  // Returns whether the domain is such a file, by its extension or by options that only such files
  // have. Throws BadInput if it is another file with such options.
  static bool is_meant_by(const Arguments& arguments);

  explicit GeoFile(const Arguments& arguments);
  ~GeoFile();
  GeoFile(const GeoFile&) = delete;
  GeoFile& operator=(const GeoFile&) = delete;

  // All of these throw Failure. read() must be called first.
  void read();
  void add_to(pnpbs_domain domain, pnpbs_context context, double corner_angle) const;
  // Returns the message, which must be the last one of the library, with its points also in
  // degrees.
  std::string explained(const std::string& message) const;

  // The projection as texts, which are empty if it is unknown.
  struct Projection {
    std::string name, unit, proj, wkt, prj;
    double least_scale = 1, greatest_scale = 1;
  };
  Projection projection() const;
  std::vector<std::string> notes() const;
  // Returns whether the file has lines that are not among the shapes.
  bool leaves_out_lines() const;

 private:
  void check(pnpbs_status status) const;

  std::string path_, layer_, projection_, unit_, tag_field_, region_field_;
  std::unique_ptr<GeoLibrary> library_;
  pnpbs_geo_shapes shapes_ = nullptr;
};

// Returns the unit of length of x, y and d: that of --unit, or of the projection of a geographic
// file, or "" if it is not known. `geo` is null for other domains.
std::string unit_of_length(const Arguments& arguments, const GeoFile* geo);

}  // namespace pnpbs::tool
