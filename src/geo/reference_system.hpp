// SPDX-License-Identifier: BSD-3-Clause
// What coordinates mean: longitude and latitude on an ellipsoid, or x and y of a projection; and
// the way from one such system to another, by PROJ. Coordinates are longitude before latitude, and
// x to the east before y to the north, whatever order a register of such systems has them in.
#pragma once

#include <ogr_srs_api.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/types.hpp"

namespace pnpbs::geo {

class ReferenceSystem {
 public:
  ReferenceSystem() = default;  // none
  static ReferenceSystem copy_of(OGRSpatialReferenceH system);
  // A code ("EPSG:2180"), a string of PROJ's, WKT or the path of a .prj file. Throws Error.
  static ReferenceSystem called(const std::string& text);
  // Of the data's own ellipsoid; for systems other than none.
  static ReferenceSystem utm(const ReferenceSystem& data, int zone, bool north);
  // The same: Lambert's azimuthal equal-area projection about a point in degrees.
  static ReferenceSystem azimuthal(const ReferenceSystem& data, double longitude, double latitude);

  // The same: the stereographic projection from a point in degrees.
  static ReferenceSystem stereographic(const ReferenceSystem& data, const Point<2>& from);

  explicit operator bool() const { return handle_ != nullptr; }
  OGRSpatialReferenceH get() const { return handle_.get(); }
  bool is_geographic() const;
  bool has_degrees() const;            // of geographic ones
  ReferenceSystem geographic() const;  // longitude and latitude beneath it
  // The same projection in another unit of length, which is so many metres.
  ReferenceSystem in_unit(const std::string& unit, double metres) const;

  // Texts; "" for none, or where the form cannot tell it.
  std::string name() const;
  std::string unit() const;  // of its coordinates
  std::string proj() const;  // PROJ's
  std::string wkt() const;   // WKT 2 (ISO 19162:2019)
  std::string prj() const;   // ESRI's dialect of WKT 1, as in .prj files

 private:
  struct Release {
    void operator()(OGRSpatialReferenceH system) const { OSRRelease(system); }
  };
  using Handle = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, Release>;
  explicit ReferenceSystem(OGRSpatialReferenceH system);
  std::string exported(const char* format) const;

  Handle handle_;
};

class Transformation {
 public:
  // Throws Error where there is no way from one to the other.
  Transformation(const ReferenceSystem& from, const ReferenceSystem& to);

  // In place; what has no place in the other system becomes infinite. What PROJ says to the first
  // of these, "" if there is none.
  std::string apply(std::vector<Point<2>>& points) const;

 private:
  struct Destroy {
    void operator()(OGRCoordinateTransformationH way) const {
      OCTDestroyCoordinateTransformation(way);
    }
  };
  std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, Destroy> handle_;
};

}  // namespace pnpbs::geo
