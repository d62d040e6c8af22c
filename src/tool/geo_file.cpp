// SPDX-License-Identifier: BSD-3-Clause
#include "tool/geo_file.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <string>

#include "base/build_config.hpp"
#include "base/error.hpp"
#include "base/extension.hpp"
#include "tool/exit.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {
namespace {

// The library is never closed, because GDAL registers functions that run at the end of the process.
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
  find(library, build_info, "pnpbs_geo_build_info");
  find(library, last_error, "pnpbs_geo_last_error");
  find(library, read_regions, "pnpbs_geo_read_regions");
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

namespace {

// Other formats that GDAL reads require one of the options.
constexpr const char* geo_endings[] = {"geojson", "json", "shp", "gpkg", "fgb", "gml", "kml"};
constexpr const char* other_endings[] = {"poly", "msh", "stl", "off", "obj", "ply", "smesh"};

template <class List>
bool is_in(const std::string& word, const List& list) {
  return std::ranges::find(list, word) != std::end(list);
}

std::string projection_of(const SphereRequest& sphere) {
  return "sphere(" + number_text(sphere.outside[0]) + "," + number_text(sphere.outside[1]) + ")";
}

const char* or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

}  // namespace

bool GeoFile::is_meant_by(const Arguments& arguments) {
  const std::string ending = extension_of(arguments.domain);
  std::string option;
  for (const auto& [name, value] :
       {std::pair{"--sphere", std::string(arguments.sphere ? "given" : "")},
        std::pair{"--projection", arguments.projection}, std::pair{"--layer", arguments.layer},
        std::pair{"--tag-field", arguments.tag_field},
        std::pair{"--region-field", arguments.region_field}})
    if (!value.empty()) option = name;
  const bool is_other =
      arguments.domain == "-" || arguments.domain.ends_with(')') || is_in(ending, other_endings);
  if (arguments.domain.empty() && (option.empty() || option == "--sphere")) return false;
  if (arguments.domain.empty())
    throw BadInput(option + " is for the file of --domain, and there is none");
  if (!option.empty() && is_other)
    throw BadInput(option + " is for GeoJSON, shapefiles and other files that GDAL reads, and '" +
                   arguments.domain + "' is none of these");
  return !option.empty() || is_in(ending, geo_endings);
}

GeoFile::GeoFile(const Arguments& arguments)
    : path_(arguments.domain),
      layer_(arguments.layer),
      projection_(arguments.sphere ? projection_of(*arguments.sphere) : arguments.projection),
      unit_(arguments.sphere ? "" : arguments.unit),
      tag_field_(arguments.tag_field),
      region_field_(arguments.region_field) {}

GeoFile::~GeoFile() {
  if (shapes_) library_->destroy(&shapes_);
}

void GeoFile::check(pnpbs_status status) const {
  if (status >= 0) return;
  std::string message = library_->last_error();
  // Messages of the library name its arguments; users of the command know these as options.
  for (const char* name : {"projection", "unit"}) {
    const std::string argument = std::string("argument ") + name;
    if (message.starts_with(argument))
      message.replace(0, argument.size(), std::string("--") + name);
  }
  throw Failure(exit_code_of(status), message);
}

void GeoFile::read() {
  library_ = std::make_unique<GeoLibrary>();
  check(library_->read_regions(path_.c_str(), or_null(layer_), or_null(projection_), or_null(unit_),
                               or_null(tag_field_), or_null(region_field_), &shapes_));
}

void GeoFile::add_to(pnpbs_domain domain, pnpbs_context context, double corner_angle) const {
  check(library_->add_to_domain(shapes_, context, domain, corner_angle));
}

std::string GeoFile::explained(const std::string& message) const {
  return shapes_ ? library_->explain(shapes_, message.c_str()) : message;
}

GeoFile::Projection GeoFile::projection() const {
  const char *name, *unit, *proj, *wkt, *prj;
  check(library_->projection(shapes_, &name, &unit, &proj, &wkt, &prj));
  Projection projection{name, unit, proj, wkt, prj};
  check(library_->scale(shapes_, &projection.least_scale, &projection.greatest_scale));
  return projection;
}

std::vector<std::string> GeoFile::notes() const {
  std::int32_t count = 0;
  check(library_->note_count(shapes_, &count));
  std::vector<std::string> notes;
  for (std::int32_t k = 0; k < count; ++k) {
    const char* note = "";
    check(library_->get_note(shapes_, k, &note));
    notes.emplace_back(note);
  }
  return notes;
}

bool GeoFile::leaves_out_lines() const {
  std::int32_t count = 0;
  check(library_->note_count(shapes_, &count));
  bool any = false;
  for (std::int32_t k = 0; k < count; ++k) {
    std::int32_t code = 0;
    check(library_->get_note_data(shapes_, k, &code, nullptr));
    any = any || code == PNPBS_GEO_NOTE_LINES_LEFT_OUT;
  }
  return any;
}

std::string unit_of_length(const Arguments& arguments, const GeoFile* geo) {
  if (!arguments.unit.empty() || arguments.sphere || !geo) return arguments.unit;
  const std::string unit = geo->projection().unit;
  return unit == "metre" ? "m" : unit == "kilometre" ? "km" : unit;
}

}  // namespace pnpbs::tool
