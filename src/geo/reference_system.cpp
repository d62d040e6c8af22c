// SPDX-License-Identifier: BSD-3-Clause
#include "geo/reference_system.hpp"

#include <cpl_conv.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "geo/gdal_messages.hpp"
#include "geo/gdal_setup.hpp"

namespace pnpbs::geo {
namespace {

std::string taken(char* text) {
  const std::string result = text ? text : "";
  CPLFree(text);
  return result;
}

// Returns an angle as "52 N" or "21 E", and as "0" on the equator and the prime meridian.
std::string angle_text(double degrees, char positive, char negative) {
  const std::string number = number_text(std::fabs(degrees));
  if (degrees == 0) return number;
  return number + " " + (degrees > 0 ? positive : negative);
}

}  // namespace

ReferenceSystem::ReferenceSystem(OGRSpatialReferenceH system) : handle_(system) {
  OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
}

ReferenceSystem ReferenceSystem::copy_of(OGRSpatialReferenceH system) {
  const OGRSpatialReferenceH copy = OSRClone(system);
  if (OSRIsCompound(copy)) OSRStripVertical(copy);
  return ReferenceSystem(copy);
}

ReferenceSystem ReferenceSystem::called(const std::string& text) {
  set_up_gdal();
  const GdalMessages messages;
  ReferenceSystem system(OSRNewSpatialReference(nullptr));
  const bool is_address = text.starts_with("http") || text.starts_with("/vsi");
  if (is_address || OSRSetFromUserInput(system.get(), text.c_str()) != OGRERR_NONE)
    throw Error(ErrorKind::argument,
                "argument projection = '" + text + "' names no projection that PROJ knows" +
                    (messages.failed() ? " (" + messages.failure() + ")" : "") +
                    "; it is a code such as EPSG:2180, a string such as '+proj=utm +zone=34 "
                    "+datum=WGS84 +units=km', WKT, a .prj file, auto, or none");
  return copy_of(system.get());
}

ReferenceSystem ReferenceSystem::utm(const ReferenceSystem& data, int zone, bool north) {
  ReferenceSystem system = data.geographic();
  const std::string datum = system.name();
  OSRSetUTM(system.get(), zone, north);
  const std::string name = datum + " / UTM zone " + std::to_string(zone) + (north ? "N" : "S");
  OSRSetProjCS(system.get(), name.c_str());
  OSRAutoIdentifyEPSG(system.get());
  const char* code = OSRGetAuthorityCode(system.get(), nullptr);
  return code ? called("EPSG:" + std::string(code)) : std::move(system);
}

ReferenceSystem ReferenceSystem::azimuthal(const ReferenceSystem& data, double longitude,
                                           double latitude) {
  ReferenceSystem system = data.geographic();
  const std::string name = system.name() + " / Lambert azimuthal equal-area at " +
                           angle_text(latitude, 'N', 'S') + ", " + angle_text(longitude, 'E', 'W');
  OSRSetProjCS(system.get(), name.c_str());
  OSRSetLAEA(system.get(), latitude, longitude, 0, 0);
  return system;
}

ReferenceSystem ReferenceSystem::stereographic(const ReferenceSystem& data, const Point<2>& from) {
  ReferenceSystem system = data.geographic();
  const std::string name = system.name() + " on a sphere";
  OSRSetProjCS(system.get(), name.c_str());
  OSRSetStereographic(system.get(), -from[1], std::remainder(from[0] + 180, 360), 1, 0, 0);
  return system;
}

bool ReferenceSystem::is_geographic() const { return handle_ && OSRIsGeographic(get()); }

bool ReferenceSystem::has_degrees() const {
  return std::fabs(OSRGetAngularUnits(get(), nullptr) * 180 / std::numbers::pi - 1) < 1e-9;
}

ReferenceSystem ReferenceSystem::geographic() const {
  const GdalMessages messages;
  const OGRSpatialReferenceH beneath = OSRCloneGeogCS(get());
  if (!beneath)
    throw Error(ErrorKind::file, "the coordinate reference system '" + name() +
                                     "' has no ellipsoid: it cannot be projected");
  OSRDemoteTo2D(beneath, nullptr);
  return ReferenceSystem(beneath);
}

ReferenceSystem ReferenceSystem::in_unit(const std::string& unit, double metres) const {
  ReferenceSystem system = copy_of(get());
  if (std::fabs(OSRGetLinearUnits(get(), nullptr) - metres) < 1e-12 * metres) return system;
  const GdalMessages messages;
  const std::string renamed = name() + " in " + unit;
  if (OSRSetLinearUnitsAndUpdateParameters(system.get(), unit.c_str(), metres) != OGRERR_NONE)
    throw Error(ErrorKind::argument, "'" + name() + "' cannot be converted to the unit " + unit);
  OSRSetProjCS(system.get(), renamed.c_str());
  return system;
}

std::string ReferenceSystem::name() const {
  const char* name = handle_ ? OSRGetName(get()) : nullptr;
  return name ? name : "";
}

std::string ReferenceSystem::unit() const {
  if (!handle_) return "";
  char* name = nullptr;  // owned by the system
  if (is_geographic())
    OSRGetAngularUnits(get(), &name);
  else
    OSRGetLinearUnits(get(), &name);
  return name ? name : "";
}

std::string ReferenceSystem::proj() const {
  const GdalMessages messages;
  char* text = nullptr;
  if (handle_) OSRExportToProj4(get(), &text);
  return taken(text);
}

std::string ReferenceSystem::exported(const char* format) const {
  const GdalMessages messages;
  const char* const options[] = {format, "MULTILINE=NO", nullptr};
  char* text = nullptr;
  if (handle_) OSRExportToWktEx(get(), &text, options);
  return taken(text);
}

std::string ReferenceSystem::wkt() const { return exported("FORMAT=WKT2_2019"); }

std::string ReferenceSystem::prj() const { return exported("FORMAT=WKT1_ESRI"); }

Transformation::Transformation(const ReferenceSystem& from, const ReferenceSystem& to) {
  const GdalMessages messages;
  handle_.reset(OCTNewCoordinateTransformation(from.get(), to.get()));
  if (!handle_)
    throw Error(ErrorKind::file, "there is no transformation from '" + from.name() + "' to '" +
                                     to.name() + "': " + messages.failure());
}

std::string Transformation::apply(std::vector<Point<2>>& points) const {
  const GdalMessages messages;
  // PROJ's counts are int, and it takes x and y in separate arrays.
  constexpr std::size_t block = 1 << 16;
  std::vector<double> x, y;
  std::vector<int> good;
  for (std::size_t begin = 0; begin < points.size(); begin += block) {
    const std::size_t count = std::min(block, points.size() - begin);
    x.resize(count), y.resize(count), good.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i)
      x[i] = points[begin + i][0], y[i] = points[begin + i][1];
    OCTTransformEx(handle_.get(), static_cast<int>(count), x.data(), y.data(), nullptr,
                   good.data());
    for (std::size_t i = 0; i < count; ++i) {
      constexpr double nowhere = std::numeric_limits<double>::infinity();
      points[begin + i] = good[i] ? Point<2>{x[i], y[i]} : Point<2>{nowhere, nowhere};
    }
  }
  return messages.failure();
}

}  // namespace pnpbs::geo
