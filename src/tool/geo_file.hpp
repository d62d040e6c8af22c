// SPDX-License-Identifier: BSD-3-Clause
// Domains in files of geographers: GeoJSON, shapefiles and whatever else GDAL reads, by
// libpnpbs_geo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pnpbs/pnpbs_geo.h"
#include "tool/arguments.hpp"

namespace pnpbs::tool {

// libpnpbs_geo, opened when a file for GDAL is named and not before: with the hundred libraries
// behind GDAL, every start would take a tenth of a second longer. Its functions have their names.
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

class GeoFile {
 public:
  // Whether the domain is such a file: by its name, or by options that only such files have.
  // Throws BadInput if it is another one with such options.
  static bool is_meant_by(const Arguments& arguments);

  explicit GeoFile(const Arguments& arguments);
  ~GeoFile();
  GeoFile(const GeoFile&) = delete;
  GeoFile& operator=(const GeoFile&) = delete;

  // All of these throw Failure. First of all, read().
  void read();
  void add_to(pnpbs_domain domain, pnpbs_context context, double corner_angle) const;
  // The message, which is the last one of the library, with its points in degrees, too.
  std::string explained(const std::string& message) const;

  // The projection in words; empty ones where it is not known.
  struct Projection {
    std::string name, unit, proj, wkt, prj;
    double least_scale = 1, greatest_scale = 1;
  };
  Projection projection() const;
  std::vector<std::string> notes() const;
  // Whether lines of the file are not among the shapes.
  bool leaves_out_lines() const;

 private:
  void check(pnpbs_status status) const;

  std::string path_, layer_, projection_, unit_, tag_field_;
  std::unique_ptr<GeoLibrary> library_;
  pnpbs_geo_shapes shapes_ = nullptr;
};

}  // namespace pnpbs::tool
