// SPDX-License-Identifier: BSD-3-Clause
#include "geo/shape_file.hpp"

#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "base/point_text.hpp"
#include "geo/gdal_messages.hpp"
#include "geo/gdal_setup.hpp"

namespace pnpbs::geo {
namespace {

[[noreturn]] void reject_file(const MessageText& message) { throw Error(ErrorKind::file, message); }

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, CloseDataset>;

struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, DestroyFeature>;

bool exists(const std::string& path) {
  VSIStatBufL status;
  return VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

bool is_shapefile_without_index(const std::string& path) {
  if (extension_of(path) != "shp") return false;
  const std::string stem = path.substr(0, path.size() - 3);
  return !exists(stem + "shx") && !exists(stem + "SHX");
}

// Returns advice for a shapefile without index. GDAL's message names an option, and the advice says
// how to set it.
std::string advice_on(const std::string& path) {
  if (!is_shapefile_without_index(path)) return "";
  return "\nA shapefile is several files of one name: provide its .shx, or recreate it "
         "with\nogrinfo --config SHAPE_RESTORE_SHX YES '" +
         path + "'";
}

Dataset open_file(const std::string& path, GdalMessages& messages) {
  set_up_gdal();
  if (!exists(path) && path.find(':') == std::string::npos)
    reject_file("cannot open '" + path + "': there is no such file");
  messages.forget();
  Dataset dataset(GDALOpenEx(path.c_str(),
                             GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr,
                             nullptr, nullptr));
  if (!dataset) reject_file("cannot read '" + path + "': " + messages.failure() + advice_on(path));
  return dataset;
}

std::string list_of_layers(GDALDatasetH dataset) {
  std::vector<std::string> names;
  for (int k = 0; k < GDALDatasetGetLayerCount(dataset); ++k)
    if (!GDALDatasetIsLayerPrivate(dataset, k))
      names.emplace_back(OGR_L_GetName(GDALDatasetGetLayer(dataset, k)));
  return list_text(names, 20);
}

OGRLayerH layer_of(GDALDatasetH dataset, const std::string& path, const std::string& name) {
  const int count = GDALDatasetGetLayerCount(dataset);
  if (count == 0) reject_file("'" + path + "' has no layers");
  if (name.empty()) {
    if (count == 1) return GDALDatasetGetLayer(dataset, 0);
    reject_file("'" + path + "' has " + std::to_string(count) +
                " layers, so the one to read must be named: " + list_of_layers(dataset));
  }
  const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
  if (!layer)
    reject_file("'" + path + "' has no layer '" + name + "'; it has: " + list_of_layers(dataset));
  return layer;
}

// ------------------------------------------------------------------ tags -----------------------
// A field of a layer, whose values are tags.
class Field {
 public:
  Field(OGRLayerH layer, std::string name, const LayerShapes& shapes)
      : name_(std::move(name)), shapes_(shapes) {
    if (name_.empty()) return;
    const OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    index_ = OGR_FD_GetFieldIndex(definition, name_.c_str());
    if (index_ < 0)
      reject_file(shapes.name + " has no field '" + name_ + "'; it has: " + fields_of(definition));
    type_ = OGR_Fld_GetType(OGR_FD_GetFieldDefn(definition, index_));
  }

  explicit operator bool() const { return !name_.empty(); }
  bool has_integers() const { return type_ == OFTInteger || type_ == OFTInteger64; }
  bool has_numbers() const { return has_integers() || type_ == OFTReal; }

  GIntBig integer_of(OGRFeatureH feature) const {
    require_value(feature);
    return OGR_F_GetFieldAsInteger64(feature, index_);
  }
  double number_of(OGRFeatureH feature) const {
    require_value(feature);
    return OGR_F_GetFieldAsDouble(feature, index_);
  }
  std::string text_of(OGRFeatureH feature) const {
    require_value(feature);
    const std::string text = OGR_F_GetFieldAsString(feature, index_);
    if (text.empty()) reject(feature, "is empty");
    return text;
  }

  [[noreturn]] void reject(OGRFeatureH feature, const std::string& what) const {
    reject_file(shapes_.name + ": field '" + name_ + "' of feature " +
                std::to_string(OGR_F_GetFID(feature)) + " " + what);
  }

 private:
  static std::string fields_of(OGRFeatureDefnH definition) {
    std::vector<std::string> names;
    for (int k = 0; k < OGR_FD_GetFieldCount(definition); ++k)
      names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, k)));
    return names.empty() ? "none" : list_text(names, 20);
  }

  void require_value(OGRFeatureH feature) const {
    if (!OGR_F_IsFieldSetAndNotNull(feature, index_)) reject(feature, "has no value");
  }

  std::string name_;
  const LayerShapes& shapes_;
  int index_ = -1;
  OGRFieldType type_ = OFTString;
};

using TagLimits = std::numeric_limits<std::int32_t>;

// The tags of features, from a field of the layer.
class TagField {
 public:
  TagField(OGRLayerH layer, const std::string& name, LayerShapes& shapes)
      : field_(layer, name, shapes), shapes_(shapes) {}

  std::int32_t of(OGRFeatureH feature) {
    if (!field_) return 1;
    return field_.has_integers() ? number_of(feature) : number_of_text(feature);
  }

 private:
  std::int32_t number_of(OGRFeatureH feature) const {
    const GIntBig value = field_.integer_of(feature);
    if (value == 0 || value < TagLimits::min() || value > TagLimits::max())
      field_.reject(
          feature, "is " + std::to_string(value) + ": a tag is an integer of 32 bits other than 0");
    return static_cast<std::int32_t>(value);
  }

  std::int32_t number_of_text(OGRFeatureH feature) {
    const std::string text = field_.text_of(feature);
    const auto next = static_cast<std::int32_t>(numbers_.size() + 1);
    const auto [found, is_new] = numbers_.try_emplace(text, next);
    if (is_new) shapes_.tag_names[next] = text;
    return found->second;
  }

  Field field_;
  LayerShapes& shapes_;
  std::map<std::string, std::int32_t> numbers_;
};

// The regions of features, from a field of the layer.
class RegionField {
 public:
  RegionField(OGRLayerH layer, const std::string& name, LayerShapes& shapes)
      : field_(layer, name, shapes), shapes_(shapes), are_tags_(field_.has_numbers()) {}

  explicit operator bool() const { return static_cast<bool>(field_); }

  void take(OGRFeatureH feature) {
    // Formats without a type for integers store them as real numbers.
    const double number = field_.has_numbers() ? field_.number_of(feature) : 0;
    const bool fits = number >= TagLimits::min() && number <= TagLimits::max();
    if (field_.has_integers() && !fits)
      field_.reject(feature, "is " + std::to_string(field_.integer_of(feature)) +
                                 ": the number of a region is an integer of 32 bits");
    are_tags_ = are_tags_ && fits && number == std::trunc(number);
    values_[OGR_F_GetFID(feature)] = {number, field_.text_of(feature)};
  }

  // Stores the regions of the features that were taken.
  void number_regions() {
    std::map<Value, std::int32_t> numbers;
    for (const auto& [feature, value] : values_) numbers[value] = 0;
    std::int32_t count = 0;
    for (auto& [value, number] : numbers) {
      number = are_tags_ ? static_cast<std::int32_t>(value.first) : ++count;
      if (!are_tags_) shapes_.region_names[number] = value.second;
    }
    for (const auto& [feature, value] : values_) shapes_.regions[feature] = numbers.at(value);
  }

 private:
  using Value = std::pair<double, std::string>;  // number, or 0 if the field has texts; text

  Field field_;
  LayerShapes& shapes_;
  bool are_tags_;
  std::map<std::int64_t, Value> values_;
};

// ------------------------------------------------------------------ geometry -------------------
// Reads the geometry of features.
class GeometryReader {
 public:
  explicit GeometryReader(LayerShapes& shapes) : shapes_(shapes) {}

  // Adds a geometry, and returns whether it has polygons. GDAL approximates curves by straight
  // segments.
  bool read(OGRGeometryH geometry, std::int64_t feature, std::int32_t tag) {
    feature_ = feature;
    tag_ = tag;
    has_height_ = has_height_ || OGR_G_Is3D(geometry);
    const std::ptrdiff_t before = std::ssize(shapes_.paths);
    if (OGR_G_HasCurveGeometry(geometry, TRUE)) {
      const OGRGeometryH linear = OGR_G_GetLinearGeometry(geometry, 0, nullptr);
      add(linear);
      OGR_G_DestroyGeometry(linear);
    } else {
      add(geometry);
    }
    return std::any_of(shapes_.paths.begin() + before, shapes_.paths.end(),
                       [](const Path& path) { return path.kind != PathKind::line; });
  }

  bool has_height() const { return has_height_; }

 private:
  void add(OGRGeometryH geometry) {
    if (OGR_G_IsEmpty(geometry)) return;
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    switch (type) {
      case wkbPoint:
        shapes_.spots.push_back({feature_, tag_, points_of(geometry).front()});
        return;
      case wkbLineString:
        return add_path(PathKind::line, geometry);
      case wkbPolygon:
      case wkbTriangle:
        for (int ring = 0; ring < OGR_G_GetGeometryCount(geometry); ++ring)
          add_path(ring == 0 ? PathKind::outline : PathKind::hole,
                   OGR_G_GetGeometryRef(geometry, ring));
        return;
      case wkbMultiPoint:
      case wkbMultiLineString:
      case wkbMultiPolygon:
      case wkbGeometryCollection:
        for (int part = 0; part < OGR_G_GetGeometryCount(geometry); ++part)
          add(OGR_G_GetGeometryRef(geometry, part));
        return;
      default:
        reject_file(name() + " is a " + OGRGeometryTypeToName(type) +
                    "; polygons, lines and points can be read");
    }
  }

  void add_path(PathKind kind, OGRGeometryH geometry) {
    if (OGR_G_GetPointCount(geometry) > 0)
      shapes_.paths.push_back({kind, feature_, tag_, points_of(geometry)});
  }

  std::vector<Point<2>> points_of(OGRGeometryH geometry) const {
    std::vector<Point<2>> points(static_cast<std::size_t>(OGR_G_GetPointCount(geometry)));
    constexpr int stride = sizeof(Point<2>);
    OGR_G_GetPoints(geometry, points.data(), stride, &points.data()->at(1), stride, nullptr, 0);
    for (const Point<2>& point : points)
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
        reject_file(name() + " has a point that is not finite, " + point_text(point));
    return points;
  }

  std::string name() const { return shapes_.name + ": feature " + std::to_string(feature_); }

  LayerShapes& shapes_;
  std::int64_t feature_ = 0;
  std::int32_t tag_ = 1;
  bool has_height_ = false;
};

void read_features(OGRLayerH layer, const std::string& tag_field, const std::string& region_field,
                   GdalMessages& messages, LayerShapes& shapes) {
  TagField tags(layer, tag_field, shapes);
  RegionField regions(layer, region_field, shapes);
  GeometryReader reader(shapes);
  std::int64_t features = 0, without_shape = 0;
  OGR_L_ResetReading(layer);
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    ++features;
    const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
    if (!geometry || OGR_G_IsEmpty(geometry))
      ++without_shape;
    else if (reader.read(geometry, OGR_F_GetFID(feature.get()), tags.of(feature.get())) && regions)
      regions.take(feature.get());
  }
  regions.number_regions();
  // GDAL returns no feature at the end of the layer and also after a failure.
  if (messages.failed())
    reject_file("cannot read " + shapes.name + " to its end; features read: " +
                std::to_string(features) + "; " + messages.failure());
  if (features == 0) reject_file(shapes.name + " is empty");
  if (shapes.paths.empty() && shapes.spots.empty())
    reject_file(shapes.name + " has no shapes: none of its " + std::to_string(features) +
                " features has a geometry");
  if (without_shape > 0)
    shapes.notes.emplace_back(NoteCode::no_geometry,
                              std::to_string(without_shape) + " of " + std::to_string(features) +
                                  " features have no geometry and were left out",
                              without_shape);
  if (reader.has_height())
    shapes.notes.emplace_back(NoteCode::heights_left_out, "heights in the file are left out");
}

}  // namespace

LayerShapes read_layer(const std::string& path, const std::string& layer,
                       const std::string& tag_field, const std::string& region_field) {
  GdalMessages messages;
  const Dataset dataset = open_file(path, messages);
  const OGRLayerH chosen = layer_of(dataset.get(), path, layer);
  LayerShapes shapes;
  shapes.name = "layer '" + std::string(OGR_L_GetName(chosen)) + "' of '" + path + "'";
  if (const OGRSpatialReferenceH system = OGR_L_GetSpatialRef(chosen))
    shapes.system = ReferenceSystem::copy_of(system);
  messages.forget();
  read_features(chosen, tag_field, region_field, messages, shapes);
  return shapes;
}

}  // namespace pnpbs::geo
