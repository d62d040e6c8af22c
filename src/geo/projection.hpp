// SPDX-License-Identifier: BSD-3-Clause
// Projection from the coordinates of a file to those in which nodes are placed.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/message_text.hpp"
#include "base/types.hpp"
#include "geo/reference_system.hpp"

namespace pnpbs::geo {

// A straight segment in the plane of longitude and latitude.
struct Leg {
  Point<2> from, to;
  bool operator==(const Leg&) const = default;
};

// The way between two points in degrees: one leg from end to end, or two if it crosses 180 degrees
// or a pole. At 180 degrees each of the two legs contains the whole way, half of it beyond the
// valid longitudes. At a pole, each leg is one half.
class Legs {
 public:
  static Legs straight(const Point<2>& a, const Point<2>& b) { return Legs({{{a, b}, {}}}, 1); }
  // Returns the shortest way around the Earth. Points must be canonical, see
  // Projection::canonical(). A pole is on every meridian.
  static Legs shortest(const Point<2>& a, const Point<2>& b);

  const Leg* begin() const { return legs_.data(); }
  const Leg* end() const { return legs_.data() + count_; }
  bool operator==(const Legs&) const = default;
  // Returns the middle of the way, or the pole on it.
  Point<2> middle() const;

 private:
  Legs(const std::array<Leg, 2>& legs, std::size_t count) : legs_(legs), count_(count) {}

  std::array<Leg, 2> legs_;
  std::size_t count_;
};

// Returns the distance of a point from the great circle through a and b, relative to its distance
// from the nearer of them.
double off_great_circle(const Point<2>& place, const Point<2>& a, const Point<2>& b);

// A projection of the points of a file. It is the identity if they stay as they are.
class Projection {
 public:
  // Chooses the projection for points in the system of `data`. `request`: "none" keeps the
  // coordinates; "auto" takes the UTM zone of the points, or else Lambert's azimuthal equal-area
  // projection about their centre; "" means auto for longitude and latitude, else none;
  // "sphere(LONGITUDE,LATITUDE)" takes the stereographic projection of a sphere from that point;
  // other texts see ReferenceSystem::called(). `unit` is "", "m" or "km". Throws Error.
  Projection(const ReferenceSystem& data, const std::vector<Point<2>>& points,
             const std::string& request, const std::string& unit);

  bool on_sphere() const { return on_sphere_; }
  double sphere_radius() const;  // in the unit of the points; 0: not on a sphere
  bool is_identity() const { return !forward_; }
  // Returns the reference system of the projected points. It is empty if that of the data is
  // unknown.
  const ReferenceSystem& system() const { return target_; }
  // Returns the unique form of a point in degrees: the longitude is above -180 and at most 180, and
  // 0 at a pole.
  Point<2> canonical(const Point<2>& point) const;
  // Returns the way in the data whose projection is the straight segment between two canonical
  // points; on a sphere, the shortest way.
  Legs legs_of(const Point<2>& a, const Point<2>& b) const;
  // Returns the distance of a point from the projected segment between a and b, relative to its
  // distance from the nearer end. A point on the straight way in the data may be far from it.
  // Returns 0 if the data are not projected.
  double off_way(const Point<2>& point, const Point<2>& a, const Point<2>& b) const;
  // A point that cannot be projected.
  struct Fault {
    std::size_t index;
    MessageText reason;
  };
  // Projects canonical points in place. If a point cannot be projected, returns its index and the
  // reason, else nothing.
  std::optional<Fault> project(std::vector<Point<2>>& points) const;
  // Convert projected points to degrees on the ellipsoid of the data, or back. Points without a
  // counterpart become infinite. Throw Error if the system of the data is unknown.
  void to_degrees(std::vector<Point<2>>& points) const;
  void from_degrees(std::vector<Point<2>>& points) const;
  // The smallest and largest ratio of projected lengths to lengths on the ellipsoid.
  struct Scale {
    double least = 1, greatest = 1;
  };
  // Returns the scale along meridians and parallels at a sample of the projected points. Both
  // values are 1 if the system of the data is unknown.
  Scale scale_at(const std::vector<Point<2>>& points) const;

 private:
  void choose_target(const std::vector<Point<2>>& points, const std::string& request);
  void take_unit(const std::string& unit);
  void find_poles();
  void restore_poles(const std::vector<Point<2>>& projected, std::vector<Point<2>>& degrees) const;

  ReferenceSystem data_, target_;
  bool on_sphere_ = false;
  bool wraps_ = false;                                // the data are degrees that are projected
  std::optional<Transformation> forward_, backward_;  // empty: the identity
  // Transformations from the target to degrees and back.
  std::optional<Transformation> degrees_, of_degrees_;
  std::vector<Point<2>> poles_;  // projected south and north pole
};

}  // namespace pnpbs::geo
