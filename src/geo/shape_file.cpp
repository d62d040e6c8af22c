// SPDX-License-Identifier: BSD-3-Clause
#include "geo/shape_file.hpp"

#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>

#include "base/error.hpp"
#include "base/extension.hpp"
#include "base/point_text.hpp"
#include "geo/gdal_messages.hpp"

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

void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

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
  register_drivers();
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
// The tags of features, from a field of the layer.
class TagField {
 public:
  TagField(OGRLayerH layer, const std::string& name, LayerShapes& shapes)
      : name_(name), shapes_(shapes) {
    if (name.empty()) return;
    const OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    index_ = OGR_FD_GetFieldIndex(definition, name.c_str());
    if (index_ < 0)
      reject_file(shapes.name + " has no field '" + name + "'; it has: " + fields_of(definition));
    const OGRFieldType type = OGR_Fld_GetType(OGR_FD_GetFieldDefn(definition, index_));
    is_number_ = type == OFTInteger || type == OFTInteger64;
  }

  std::int32_t of(OGRFeatureH feature) {
    if (name_.empty()) return 1;
    if (!OGR_F_IsFieldSetAndNotNull(feature, index_)) reject(feature, "has no value");
    return is_number_ ? number_of(feature) : number_of_text(feature);
  }

 private:
  static std::string fields_of(OGRFeatureDefnH definition) {
    std::vector<std::string> names;
    for (int k = 0; k < OGR_FD_GetFieldCount(definition); ++k)
      names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, k)));
    return names.empty() ? "none" : list_text(names, 20);
  }

  [[noreturn]] void reject(OGRFeatureH feature, const std::string& what) const {
    reject_file(shapes_.name + ": field '" + name_ + "' of feature " +
                std::to_string(OGR_F_GetFID(feature)) + " " + what);
  }

  std::int32_t number_of(OGRFeatureH feature) const {
    const GIntBig value = OGR_F_GetFieldAsInteger64(feature, index_);
    using Limits = std::numeric_limits<std::int32_t>;
    if (value == 0 || value < Limits::min() || value > Limits::max())
      reject(feature,
             "is " + std::to_string(value) + ": a tag is an integer of 32 bits other than 0");
    return static_cast<std::int32_t>(value);
  }

  std::int32_t number_of_text(OGRFeatureH feature) {
    const std::string text = OGR_F_GetFieldAsString(feature, index_);
    if (text.empty()) reject(feature, "is empty");
    const auto next = static_cast<std::int32_t>(numbers_.size() + 1);
    const auto [found, is_new] = numbers_.try_emplace(text, next);
    if (is_new) shapes_.tag_names[next] = text;
    return found->second;
  }

  std::string name_;
  LayerShapes& shapes_;
  int index_ = -1;
  bool is_number_ = false;
  std::map<std::string, std::int32_t> numbers_;
};

// ------------------------------------------------------------------ geometry -------------------
// Reads the geometry of features.
class GeometryReader {
 public:
  explicit GeometryReader(LayerShapes& shapes) : shapes_(shapes) {}

  // Adds a geometry. GDAL approximates curves by straight segments.
  void read(OGRGeometryH geometry, std::int64_t feature, std::int32_t tag) {
    feature_ = feature;
    tag_ = tag;
    has_height_ = has_height_ || OGR_G_Is3D(geometry);
    if (!OGR_G_HasCurveGeometry(geometry, TRUE)) return add(geometry);
    const OGRGeometryH linear = OGR_G_GetLinearGeometry(geometry, 0, nullptr);
    add(linear);
    OGR_G_DestroyGeometry(linear);
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

void read_features(OGRLayerH layer, const std::string& tag_field, GdalMessages& messages,
                   LayerShapes& shapes) {
  TagField tags(layer, tag_field, shapes);
  GeometryReader reader(shapes);
  std::int64_t features = 0, without_shape = 0;
  OGR_L_ResetReading(layer);
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    ++features;
    const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
    if (!geometry || OGR_G_IsEmpty(geometry))
      ++without_shape;
    else
      reader.read(geometry, OGR_F_GetFID(feature.get()), tags.of(feature.get()));
  }
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
                       const std::string& tag_field) {
  GdalMessages messages;
  const Dataset dataset = open_file(path, messages);
  const OGRLayerH chosen = layer_of(dataset.get(), path, layer);
  LayerShapes shapes;
  shapes.name = "layer '" + std::string(OGR_L_GetName(chosen)) + "' of '" + path + "'";
  if (const OGRSpatialReferenceH system = OGR_L_GetSpatialRef(chosen))
    shapes.system = ReferenceSystem::copy_of(system);
  messages.forget();
  read_features(chosen, tag_field, messages, shapes);
  return shapes;
}

}  // namespace pnpbs::geo
