// SPDX-License-Identifier: BSD-3-Clause
// Coordinate reference systems and transformations between them by PROJ. A system defines
// coordinates as longitude and latitude on an ellipsoid, or as x and y of a projection. Longitude
// comes before latitude and x (east) before y (north), whatever order a registry defines.
#pragma once

#include <ogr_srs_api.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/types.hpp"

namespace pnpbs::geo {

// A coordinate reference system, which may be empty. Most functions require that it is not.
class ReferenceSystem {
 public:
  ReferenceSystem() = default;  // empty
  static ReferenceSystem copy_of(OGRSpatialReferenceH system);
  // Returns the system of a code ("EPSG:2180"), a string of PROJ, WKT or the path of a .prj file.
  // Throws Error.
  static ReferenceSystem called(const std::string& text);
  // Returns a UTM zone on the ellipsoid of `data`.
  static ReferenceSystem utm(const ReferenceSystem& data, int zone, bool north);
  // Returns Lambert's azimuthal equal-area projection about a point in degrees, on the ellipsoid of
  // `data`.
  static ReferenceSystem azimuthal(const ReferenceSystem& data, double longitude, double latitude);

  // Returns the stereographic projection from a point in degrees, on the ellipsoid of `data`.
  static ReferenceSystem stereographic(const ReferenceSystem& data, const Point<2>& from);

  explicit operator bool() const { return handle_ != nullptr; }
  OGRSpatialReferenceH get() const { return handle_.get(); }
  bool is_geographic() const;
  bool has_degrees() const;            // for geographic systems only
  ReferenceSystem geographic() const;  // longitude and latitude on its ellipsoid
  // Returns the same projection in another unit of length. `metres`: length of the unit.
  ReferenceSystem in_unit(const std::string& unit, double metres) const;

  // Descriptions. They are "" for an empty system, or if the format cannot express it.
  std::string name() const;
  std::string unit() const;  // unit of the coordinates
  std::string proj() const;  // PROJ string
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

// A transformation of points from one system to another.
class Transformation {
 public:
  // Throws Error if there is no transformation between the systems.
  Transformation(const ReferenceSystem& from, const ReferenceSystem& to);

  // Transforms points in place. Points without a counterpart become infinite. Returns PROJ's
  // message about the first of them, or "".
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
