// SPDX-License-Identifier: BSD-3-Clause
// The C interface of libpnpbs_geo.
#include "pnpbs/pnpbs_geo.h"

#include <gdal.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>

#include "api/floating_point.hpp"
#include "base/error.hpp"
#include "geo/grid.hpp"
#include "geo/library_error.hpp"
#include "geo/shapes.hpp"
#include "spacing/depth_rule.hpp"

using namespace pnpbs;
using namespace pnpbs::geo;

namespace {

// The shapes of a layer and the strings that callers receive.
struct Object {
  explicit Object(const Request& request) : shapes(request) {
    if (shapes.on_sphere()) return;  // on a sphere, coordinates are in space, without a projection
    const ReferenceSystem& system = shapes.projection().system();
    name = system.name(), unit = system.unit(), proj = system.proj();
    wkt = system.wkt(), prj = system.prj();
  }
  Shapes shapes;
  std::string name, unit, proj, wkt, prj;
};

// ------------------------------------------------------------------ handles --------------------
// Handles are keys and not addresses, as in libpnpbs. The keys differ from those of libpnpbs.
template <class Handle, class Object>
class Registry {
 public:
  Registry(const char* name, std::uintptr_t first) : name_(name), last_(first) {}

  Handle add(std::shared_ptr<Object> object) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::uintptr_t key = ++last_;
    objects_[key] = std::move(object);
    return reinterpret_cast<Handle>(key);
  }
  std::shared_ptr<Object> require(Handle handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == objects_.end())
      throw Error(ErrorKind::handle,
                  std::string(name_) + (handle ? ": not a live handle" : ": NULL"));
    return found->second;
  }
  void remove(Handle handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    objects_.erase(reinterpret_cast<std::uintptr_t>(handle));
  }

 private:
  std::mutex mutex_;
  const char* name_;
  std::uintptr_t last_;
  std::map<std::uintptr_t, std::shared_ptr<Object>> objects_;
};

constexpr std::uintptr_t first_key = std::uintptr_t{1} << (sizeof(std::uintptr_t) * 8 - 4);

Registry<pnpbs_geo_shapes, Object>& registry() {
  static Registry<pnpbs_geo_shapes, Object> registry("shapes", first_key);
  return registry;
}

Registry<pnpbs_geo_grid, Grid>& grids() {
  static Registry<pnpbs_geo_grid, Grid> registry("grid", 2 * first_key);
  return registry;
}

// ------------------------------------------------------------------ errors ---------------------
MessageText& last_error() {
  static thread_local MessageText message;
  return message;
}

pnpbs_status status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::argument:
      return PNPBS_ERROR_ARGUMENT;
    case ErrorKind::handle:
      return PNPBS_ERROR_HANDLE;
    case ErrorKind::state:
      return PNPBS_ERROR_STATE;
    case ErrorKind::domain:
      return PNPBS_ERROR_DOMAIN;
    case ErrorKind::spacing:
      return PNPBS_ERROR_SPACING;
    case ErrorKind::file:
      return PNPBS_ERROR_FILE;
    case ErrorKind::memory:
      return PNPBS_ERROR_MEMORY;
    default:
      return PNPBS_ERROR_INTERNAL;
  }
}

pnpbs_status report(pnpbs_status status, const auto& message) noexcept {
  try {
    last_error() = message;
  } catch (...) {
    last_error() = {};
  }
  return status;
}

// Runs the body and converts exceptions to a status and a last error.
template <class Body>
pnpbs_status guarded(const Body& body) noexcept {
  const api::DefaultArithmetic arithmetic;
  try {
    body();
    return PNPBS_OK;
  } catch (const Error& error) {
    return report(status_of(error.kind()), error.message());
  } catch (const std::bad_alloc&) {
    return report(PNPBS_ERROR_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return report(PNPBS_ERROR_INTERNAL, error.what());
  } catch (...) {
    return report(PNPBS_ERROR_INTERNAL, "internal error");
  }
}

template <class Body>
pnpbs_status guarded(pnpbs_geo_shapes shapes, const Body& body) noexcept {
  return guarded([&] { body(*registry().require(shapes)); });
}

template <class Body>
pnpbs_status guarded(pnpbs_geo_grid grid, const Body& body) noexcept {
  return guarded([&] { body(*grids().require(grid)); });
}

void require_pointer(const void* pointer, const char* argument) {
  if (!pointer) throw Error(ErrorKind::argument, std::string("argument ") + argument + " is NULL");
}

std::string text_of(const char* text) { return text ? text : ""; }

template <class Value>
void put(Value* output, const Value& value) {
  if (output) *output = value;
}

// ------------------------------------------------------------------ files ----------------------
void write_text(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (!file || std::fclose(file) != 0 || !written)
    throw Error(ErrorKind::file, "cannot write '" + path + "'");
}

void require_count(std::int64_t n) {
  if (n < 0) throw Error(ErrorKind::argument, "argument n = " + std::to_string(n) + " is negative");
}

void require_number(const char* argument, double value, bool fits) {
  if (!fits || !std::isfinite(value))
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " = " +
                                         number_text(value) + " is out of range");
}

std::vector<Point<2>> points_from(std::int64_t n, const double* coordinates) {
  require_count(n);
  if (n > 0) require_pointer(coordinates, "coordinates");
  std::vector<Point<2>> points(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {coordinates[2 * i], coordinates[2 * i + 1]};
  return points;
}

// Converts coordinates in place with PROJ, to degrees or from them.
template <class Way>
pnpbs_status change_coordinates(pnpbs_geo_shapes shapes, std::int64_t n, double* coordinates,
                                const Way& way) {
  return guarded(shapes, [&](Object& object) {
    std::vector<Point<2>> points = points_from(n, coordinates);
    way(object.shapes.projection(), points);
    for (std::size_t i = 0; i < points.size(); ++i)
      coordinates[2 * i] = points[i][0], coordinates[2 * i + 1] = points[i][1];
  });
}

}  // namespace

const char* pnpbs_geo_last_error(void) { return last_error().text().c_str(); }

const char* pnpbs_geo_build_info(void) {
  static const std::string info = [] {
    int major = 0, minor = 0, patch = 0;
    OSRGetPROJVersion(&major, &minor, &patch);
    return "GDAL: " + std::string(GDALVersionInfo("RELEASE_NAME")) +
           "\nPROJ: " + std::to_string(major) + "." + std::to_string(minor) + "." +
           std::to_string(patch) + "\n";
  }();
  return info.c_str();
}

pnpbs_status pnpbs_geo_read(const char* path, const char* layer, const char* projection,
                            const char* unit, const char* tag_field, pnpbs_geo_shapes* shapes) {
  return pnpbs_geo_read_regions(path, layer, projection, unit, tag_field, nullptr, shapes);
}

pnpbs_status pnpbs_geo_read_regions(const char* path, const char* layer, const char* projection,
                                    const char* unit, const char* tag_field,
                                    const char* region_field, pnpbs_geo_shapes* shapes) {
  return guarded([&] {
    require_pointer(shapes, "shapes");
    *shapes = nullptr;
    require_pointer(path, "path");
    const Request request{path,          text_of(layer),     text_of(projection),
                          text_of(unit), text_of(tag_field), text_of(region_field)};
    *shapes = registry().add(std::make_shared<Object>(request));
  });
}

pnpbs_status pnpbs_geo_destroy(pnpbs_geo_shapes* shapes) {
  if (!shapes || !*shapes) return PNPBS_OK;
  return guarded(*shapes, [&](Object&) {
    registry().remove(*shapes);
    *shapes = nullptr;
  });
}

pnpbs_status pnpbs_geo_add_to_domain(pnpbs_geo_shapes shapes, pnpbs_context context,
                                     pnpbs_domain domain, double corner_angle) {
  return guarded(shapes,
                 [&](Object& object) { object.shapes.add_to(domain, context, corner_angle); });
}

pnpbs_status pnpbs_geo_counts(pnpbs_geo_shapes shapes, int64_t* vertices, int64_t* boundary,
                              int64_t* inner, int64_t* points) {
  return guarded(shapes, [&](Object& object) {
    put(vertices, object.shapes.vertices());
    put(boundary, object.shapes.boundary_curves());
    put(inner, object.shapes.inner_curves());
    put(points, object.shapes.points());
  });
}

pnpbs_status pnpbs_geo_projection(pnpbs_geo_shapes shapes, const char** name, const char** unit,
                                  const char** proj, const char** wkt, const char** prj) {
  return guarded(shapes, [&](Object& object) {
    put(name, object.name.c_str());
    put(unit, object.unit.c_str());
    put(proj, object.proj.c_str());
    put(wkt, object.wkt.c_str());
    put(prj, object.prj.c_str());
  });
}

pnpbs_status pnpbs_geo_scale(pnpbs_geo_shapes shapes, double* least, double* greatest) {
  return guarded(shapes, [&](Object& object) {
    put(least, object.shapes.scale().least);
    put(greatest, object.shapes.scale().greatest);
  });
}

pnpbs_status pnpbs_geo_write_prj(pnpbs_geo_shapes shapes, const char* results) {
  return guarded(shapes, [&](Object& object) {
    require_pointer(results, "results");
    if (object.prj.empty())
      throw Error(ErrorKind::state, object.shapes.on_sphere()
                                        ? "on a sphere there is no projection"
                                        : "the file has no coordinate reference system");
    write_text(std::filesystem::path(results).replace_extension(".prj").string(), object.prj);
  });
}

pnpbs_status pnpbs_geo_to_degrees(pnpbs_geo_shapes shapes, int64_t n, double* coordinates) {
  return change_coordinates(shapes, n, coordinates, [](const Projection& projection, auto& points) {
    projection.to_degrees(points);
  });
}

pnpbs_status pnpbs_geo_from_degrees(pnpbs_geo_shapes shapes, int64_t n, double* coordinates) {
  return change_coordinates(shapes, n, coordinates, [](const Projection& projection, auto& points) {
    projection.from_degrees(points);
  });
}

const char* pnpbs_geo_explain(pnpbs_geo_shapes shapes, const char* message) {
  static thread_local std::string text;
  text = text_of(message);
  const MessageText last = last_error();
  guarded(shapes, [&](Object& object) { text = object.shapes.explained(text, last); });
  return text.c_str();
}

pnpbs_status pnpbs_geo_note_count(pnpbs_geo_shapes shapes, int32_t* count) {
  return guarded(shapes, [&](Object& object) {
    require_pointer(count, "count");
    *count = static_cast<std::int32_t>(object.shapes.notes().size());
  });
}

pnpbs_status pnpbs_geo_get_note(pnpbs_geo_shapes shapes, int32_t index, const char** note) {
  return guarded(shapes, [&](Object& object) {
    require_pointer(note, "note");
    *note = note_at(object.shapes.notes(), index).text.c_str();
  });
}

pnpbs_status pnpbs_geo_get_note_data(pnpbs_geo_shapes shapes, int32_t index, int32_t* code,
                                     int64_t* count) {
  return guarded(shapes, [&](Object& object) {
    const Note& note = note_at(object.shapes.notes(), index);
    put(code, static_cast<std::int32_t>(note.code));
    put(count, note.count);
  });
}

pnpbs_status pnpbs_geo_grid_read(const char* path, const char* variable, const char* projection,
                                 const double* low, const double* high, pnpbs_geo_grid* grid) {
  return guarded([&] {
    require_pointer(grid, "grid");
    *grid = nullptr;
    require_pointer(path, "path");
    require_pointer(low, "low");
    require_pointer(high, "high");
    const Box<2> part{{low[0], low[1]}, {high[0], high[1]}};
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
      if (!std::isfinite(low[k]) || !std::isfinite(high[k]) || !(low[k] <= high[k]))
        throw Error(ErrorKind::argument, "arguments low and high: expected the corners of a box");
    *grid = grids().add(
        std::make_shared<Grid>(GridRequest{path, text_of(variable), text_of(projection), part}));
  });
}

pnpbs_status pnpbs_geo_grid_destroy(pnpbs_geo_grid* grid) {
  if (!grid || !*grid) return PNPBS_OK;
  return guarded(*grid, [&](Grid&) {
    grids().remove(*grid);
    *grid = nullptr;
  });
}

pnpbs_status pnpbs_geo_grid_values(pnpbs_geo_grid grid, int64_t n, const double* coordinates,
                                   double* values, int32_t* inside) {
  return guarded(grid, [&](Grid& object) {
    const std::vector<Point<2>> points = points_from(n, coordinates);
    if (n > 0) require_pointer(values, "values");
    object.evaluate(points, values, inside);
  });
}

pnpbs_status pnpbs_geo_grid_slopes(pnpbs_geo_grid grid, double radius, int64_t n,
                                   const double* coordinates, double* slopes) {
  return guarded(grid, [&](Grid& object) {
    require_number("radius", radius, radius >= 0);
    const std::vector<Point<2>> points = points_from(n, coordinates);
    if (n > 0) require_pointer(slopes, "slopes");
    evaluate_slopes(object, radius, points, slopes);
  });
}

pnpbs_status pnpbs_geo_depth_spacing(int64_t n, const double* depths, const double* slopes,
                                     double nodes_per_wave, double period, double nodes_per_slope,
                                     double least_depth, double metres, double* d) {
  return guarded([&] {
    require_number("nodes_per_wave", nodes_per_wave, nodes_per_wave >= 0);
    require_number("period", period, period > 0);
    require_number("nodes_per_slope", nodes_per_slope, nodes_per_slope >= 0);
    require_number("least_depth", least_depth, least_depth > 0);
    require_number("metres", metres, metres > 0);
    require_count(n);
    if (n > 0) require_pointer(depths, "depths"), require_pointer(d, "d");
    if (n > 0 && nodes_per_slope > 0) require_pointer(slopes, "slopes");
    const DepthRule rule{nodes_per_wave, period, nodes_per_slope, least_depth, metres};
    for (std::int64_t i = 0; i < n; ++i) {
      const double slope = nodes_per_slope > 0 ? slopes[i] : 0;
      if (std::isnan(depths[i]) || std::isnan(slope))
        throw Error(ErrorKind::spacing, (std::isnan(slope) ? "slopes[" : "depths[") +
                                            std::to_string(i) + "] is not a number");
      d[i] = rule.spacing(depths[i], slope);
    }
  });
}

pnpbs_status pnpbs_geo_grid_extent(pnpbs_geo_grid grid, double* low, double* high) {
  return guarded(grid, [&](Grid& object) {
    require_pointer(low, "low");
    require_pointer(high, "high");
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
      low[k] = object.extent().low[k], high[k] = object.extent().high[k];
  });
}
