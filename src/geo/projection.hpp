// SPDX-License-Identifier: BSD-3-Clause
// From the coordinates of a file to those that nodes are placed in.
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

// The way between two places in degrees, in the plane of longitude and latitude. What goes on
// beyond 180 degrees, or over a pole, is not the straight line from one to the other there.
struct Leg {
  Point<2> from, to;
  bool operator==(const Leg&) const = default;
};

// Straight legs: one from end to end, or two with the same way in them. Of those on both sides of
// 180 degrees each has the whole way, of which half is where no longitudes are.
class Legs {
 public:
  static Legs straight(const Point<2>& a, const Point<2>& b) { return Legs({{{a, b}, {}}}, 1); }
  // Around the Earth, of places as Projection::canonical has them: a pole is on every meridian.
  static Legs shortest(const Point<2>& a, const Point<2>& b);

  const Leg* begin() const { return legs_.data(); }
  const Leg* end() const { return legs_.data() + count_; }
  bool operator==(const Legs&) const = default;
  // Of the way, or the pole that it leads over.
  Point<2> middle() const;

 private:
  Legs(const std::array<Leg, 2>& legs, std::size_t count) : legs_(legs), count_(count) {}

  std::array<Leg, 2> legs_;
  std::size_t count_;
};

// How far a place is off the great circle through two others, over how far it is from the nearer of
// these.
double off_great_circle(const Point<2>& place, const Point<2>& a, const Point<2>& b);

class Projection {
 public:
  // What `wish` makes of points in the system of `data`: "" longitude and latitude projected as
  // auto does, anything else as it is; "none" as they are; "auto" the UTM zone that they lie in, or
  // else Lambert's azimuthal equal-area projection about their middle; "sphere(LONGITUDE,LATITUDE)"
  // the stereographic one of a sphere from that point; or a name, see ReferenceSystem::called.
  // `unit` is "", "m" or "km". Throws Error.
  Projection(const ReferenceSystem& data, const std::vector<Point<2>>& points,
             const std::string& request, const std::string& unit);

  bool on_sphere() const { return on_sphere_; }
  double sphere_radius() const;  // in the unit of its points; 0 if it is not on one
  bool is_identity() const { return !forward_; }
  const ReferenceSystem& system() const { return target_; }  // none if the data's is none
  // Which of two ways to write the same place on the ellipsoid is used for points that are to be
  // projected.
  Point<2> canonical(const Point<2>& point) const;
  // The straight way between two canonical points once they are projected, or on a sphere the
  // shortest one, where it is among the coordinates of the data.
  Legs legs_of(const Point<2>& a, const Point<2>& b) const;
  // How far a third point is off that way, over how far it is from the nearer end: one of the
  // straight way in the data may be far off. 0 if they are not projected.
  double off_way(const Point<2>& point, const Point<2>& a, const Point<2>& b) const;
  // From canonical points of the data. Where one cannot be projected, its index, and why.
  struct Fault {
    std::size_t index;
    MessageText reason;
  };
  std::optional<Fault> project(std::vector<Point<2>>& points) const;
  // Degrees on the ellipsoid of the data, from projected points or back; infinite where there are
  // none. Throws Error if the system of the data is not known.
  void to_degrees(std::vector<Point<2>>& points) const;
  void from_degrees(std::vector<Point<2>>& points) const;
  // How long lengths on the ellipsoid are once projected, along meridians and parallels, at some of
  // the points, which are projected. 1 and 1 if the system of the data is not known.
  struct Scale {
    double least = 1, greatest = 1;
  };
  Scale scale_at(const std::vector<Point<2>>& points) const;

 private:
  void choose_target(const std::vector<Point<2>>& points, const std::string& request);
  void take_unit(const std::string& unit);
  void find_poles();
  void restore_poles(const std::vector<Point<2>>& projected, std::vector<Point<2>>& degrees) const;

  ReferenceSystem data_, target_;
  bool on_sphere_ = false;
  bool wraps_ = false;  // the data are degrees on an ellipsoid, to be projected
  std::optional<Transformation> forward_, backward_;    // none: the same coordinates
  std::optional<Transformation> degrees_, of_degrees_;  // from and to the target
  std::vector<Point<2>> poles_;                         // south and north, projected
};

}  // namespace pnpbs::geo
