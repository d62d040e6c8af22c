// SPDX-License-Identifier: BSD-3-Clause
#include "geo/projection.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::geo {
namespace {

bool is_pole(const Point<2>& degrees) { return std::fabs(degrees[1]) == 90; }

}  // namespace

Legs Legs::shortest(const Point<2>& a, const Point<2>& b) {
  const double first = is_pole(a) ? b[0] : a[0], last = is_pole(b) ? a[0] : b[0];
  const double across = last - first, sum = a[1] + b[1];
  // Tolerance for opposite meridians, as in canonical(). [degrees]
  constexpr double kSame = 1e-9;
  const bool is_over_pole = std::fabs(std::fabs(across) - 180) < kSame && sum != 0;
  if (is_over_pole) {
    const double pole = std::copysign(90, sum);
    return Legs({{{a, {a[0], pole}}, {{b[0], pole}, b}}}, 2);
  }
  if (std::fabs(across) <= 180) return straight({first, a[1]}, {last, b[1]});
  const double turn = std::copysign(360, across);
  return Legs({{{a, {last - turn, b[1]}}, {{first + turn, a[1]}, b}}}, 2);
}

Point<2> Legs::middle() const {
  const auto& [from, to] = legs_[0];
  const bool is_over_pole = count_ == 2 && is_pole(to);
  return is_over_pole ? to : middle_of<2>(from, to);
}

double off_great_circle(const Point<2>& place, const Point<2>& a, const Point<2>& b) {
  const Point<3> here = direction_at(place), from = direction_at(a), to = direction_at(b);
  const Point<3> normal = unit_vector(cross(from, to));
  const double near = std::min(distance<3>(here, from), distance<3>(here, to));
  return near > 0 ? std::fabs(dot(here, normal)) / near : 0;
}

namespace {

// Distance from the central meridian up to which a UTM zone is used. Zones are 6 degrees wide. At
// this distance lengths are wrong by at most 0.2 %, about as much as at the edge of the zone.
// [degrees]
constexpr double half_zone = 3.5;
// Latitudes of the ends of UTM. [degrees]
constexpr double most_northern = 84, most_southern = -80;
// Largest difference of a point that is projected and back. 0.1 m allow for projections whose
// inverse is approximate. [degrees]
constexpr double same_degrees = 1e-6;

// Number of sample points of the scale, and the distance to both sides of each.
constexpr std::size_t scale_samples = 1000;
constexpr double scale_step = 1e-4;  // degrees
constexpr double radian = std::numbers::pi / 180;

// The smallest range that contains all longitudes: from `west` over `width`. [degrees]
struct LongitudeRange {
  double west, width;
  double middle() const { return std::remainder(west + width / 2, 360); }
};

LongitudeRange longitudes_of(const std::vector<Point<2>>& degrees) {
  std::vector<double> longitudes;
  for (const Point<2>& point : degrees) longitudes.push_back(std::remainder(point[0], 360));
  std::sort(longitudes.begin(), longitudes.end());
  double gap = longitudes.front() + 360 - longitudes.back();
  double west = longitudes.front();
  for (std::size_t i = 1; i < longitudes.size(); ++i) {
    if (longitudes[i] - longitudes[i - 1] <= gap) continue;
    gap = longitudes[i] - longitudes[i - 1];
    west = longitudes[i];
  }
  return {west, 360 - gap};
}

// Returns the longitude and latitude of "sphere(LONGITUDE,LATITUDE)", or nothing if the request is
// for another projection. Throws if it is malformed.
std::optional<Point<2>> sphere_seen_from(const std::string& request) {
  constexpr std::string_view word = "sphere";
  if (!std::string_view(request).starts_with(word)) return std::nullopt;
  Point<2> degrees{};
  const char *at = request.data() + word.size(), *const end = request.data() + request.size();
  for (const auto& [sign, k] : {std::pair{'(', 0}, std::pair{',', 1}}) {
    while (at != end && *at == ' ') ++at;
    const bool is_there = at != end && *at == sign;
    at += is_there;
    while (at != end && *at == ' ') ++at;
    const auto read = std::from_chars(at, end, degrees[static_cast<std::size_t>(k)]);
    if (!is_there || read.ec != std::errc())
      at = end;
    else
      at = read.ptr;
  }
  if (at == end || std::string_view(at, end) != ")" || !(std::fabs(degrees[1]) <= 90) ||
      !(std::fabs(degrees[0]) <= 360))
    throw Error(ErrorKind::argument,
                "argument projection = '" + request +
                    "': expected sphere(LONGITUDE,LATITUDE), in degrees, of a point outside of the "
                    "domain");
  return degrees;
}

// Returns a projection for data around these points: a UTM zone if they fit in one, else Lambert's
// azimuthal equal-area projection. Throws if they extend over more than 180 degrees of longitude on
// both sides of the equator.
ReferenceSystem local_projection(const ReferenceSystem& data,
                                 const std::vector<Point<2>>& degrees) {
  const LongitudeRange range = longitudes_of(degrees);
  double south = 90, north = -90;
  for (const Point<2>& point : degrees) {
    south = std::min(south, point[1]);
    north = std::max(north, point[1]);
  }
  if (range.width > 180) {
    if (south < 0 && north > 0)
      throw Error(
          ErrorKind::argument,
          "argument projection: auto is for a part of the Earth, and the file extends over " +
              rounded_text(range.width) +
              " degrees of longitude on both sides of the "
              "equator: name a projection");
    return ReferenceSystem::azimuthal(data, 0, south >= 0 ? 90 : -90);
  }
  const int zone = std::clamp(static_cast<int>(std::floor((range.middle() + 180) / 6)) + 1, 1, 60);
  const double meridian = 6 * zone - 183;
  const double reach = std::fabs(std::remainder(range.middle() - meridian, 360)) + range.width / 2;
  if (reach <= half_zone && south >= most_southern && north <= most_northern)
    return ReferenceSystem::utm(data, zone, south + north >= 0);
  // Round to degrees, so that files that differ little have the same projection.
  return ReferenceSystem::azimuthal(data, std::round(range.middle()),
                                    std::round((south + north) / 2));
}

}  // namespace

Projection::Projection(const ReferenceSystem& data, const std::vector<Point<2>>& points,
                       const std::string& request, const std::string& unit) {
  if (data) data_ = ReferenceSystem::copy_of(data.get());
  choose_target(points, request);
  take_unit(unit);
  if (target_ && !OSRIsSame(target_.get(), data_.get())) {
    forward_.emplace(data_, target_);
    backward_.emplace(target_, data_);
  }
  wraps_ = forward_ && data_.is_geographic() && data_.has_degrees();
  if (wraps_) find_poles();
  if (!target_ || OSRIsLocal(target_.get())) return;
  const ReferenceSystem degrees = data_.geographic();
  degrees_.emplace(target_, degrees);
  of_degrees_.emplace(degrees, target_);
}

void Projection::choose_target(const std::vector<Point<2>>& points, const std::string& request) {
  const bool as_it_is = request == "none" || (request.empty() && !data_.is_geographic());
  if (as_it_is) {
    if (data_) target_ = ReferenceSystem::copy_of(data_.get());
    return;
  }
  if (!data_)
    throw Error(ErrorKind::file,
                "argument projection = '" + request +
                    "': the file has no coordinate reference system, so its coordinates cannot be "
                    "projected: add a .prj beside a shapefile, or set it by ogr2ogr -a_srs "
                    "EPSG:4326 if they are longitude and latitude");
  if (const auto outside = sphere_seen_from(request)) {
    target_ = ReferenceSystem::stereographic(data_, *outside);
    on_sphere_ = true;
    return;
  }
  if (!request.empty() && request != "auto") {
    target_ = ReferenceSystem::called(request);
    if (target_.is_geographic())
      throw Error(ErrorKind::argument,
                  "argument projection = '" + request +
                      "' is longitude and "
                      "latitude, which are angles, no lengths: name a projection, auto, or none");
    return;
  }
  std::vector<Point<2>> degrees = points;
  const Transformation to_degrees(data_, data_.geographic());
  to_degrees.apply(degrees);
  std::erase_if(degrees, [](const Point<2>& p) { return !std::isfinite(p[0] + p[1]); });
  std::erase_if(degrees, [](const Point<2>& p) { return std::fabs(p[1]) > 90; });
  if (degrees.empty())
    throw Error(ErrorKind::file, "none of the coordinates is a longitude and latitude on '" +
                                     data_.geographic().name() + "'");
  target_ = local_projection(data_, degrees);
}

void Projection::take_unit(const std::string& unit) {
  if (unit.empty()) return;
  if (on_sphere_)
    throw Error(ErrorKind::argument,
                "argument unit = '" + unit + "': on a sphere the unit is that of its radius");
  if (unit != "m" && unit != "km")
    throw Error(ErrorKind::argument, "argument unit = '" + unit + "' must be m or km");
  if (!target_ || target_.is_geographic())
    throw Error(ErrorKind::argument,
                "argument unit = '" + unit +
                    "' needs projected coordinates, and these stay as they are in the file");
  target_ = unit == "km" ? target_.in_unit("kilometre", 1000) : target_.in_unit("metre", 1);
}

void Projection::find_poles() {
  poles_ = {{0, -90}, {0, 90}};
  forward_->apply(poles_);
  for (Point<2>& pole : poles_)
    if (!std::isfinite(pole[0] + pole[1])) pole = {NAN, NAN};  // not equal to any point
}

// Corrects the degrees of projected poles. PROJ's inverse has half the digits near a pole and fails
// at some, since the argument of an arcsine exceeds 1 by rounding.
void Projection::restore_poles(const std::vector<Point<2>>& projected,
                               std::vector<Point<2>>& degrees) const {
  for (std::size_t i = 0; i < projected.size(); ++i)
    for (std::size_t k = 0; k < poles_.size(); ++k)
      if (projected[i] == poles_[k]) degrees[i] = {0, k == 0 ? -90.0 : 90.0};
}

double Projection::sphere_radius() const {
  return on_sphere_ ? OSRGetSemiMajor(target_.get(), nullptr) : 0;
}

Point<2> Projection::canonical(const Point<2>& point) const {
  if (!wraps_) return point;
  auto [longitude, latitude] = point;
  // Files are cut at 180 degrees up to rounding. The tolerance is a tenth of a millimetre.
  constexpr double kSame = 1e-9;
  if (std::fabs(std::fabs(longitude) - 180) < kSame) longitude = 180;
  if (std::fabs(std::fabs(latitude) - 90) < kSame) latitude = std::copysign(90, latitude);
  if (longitude <= -180 && longitude > -540) longitude += 360;
  if (longitude > 180 && longitude <= 540) longitude -= 360;
  if (std::fabs(latitude) == 90) longitude = 0;
  return {longitude, latitude};
}

// In a map that is cut at 180 degrees, the projected segment goes the long way around. The
// projected midpoint decides between the two.
Legs Projection::legs_of(const Point<2>& a, const Point<2>& b) const {
  const Legs straight = Legs::straight(a, b);
  if (!wraps_) return straight;
  const Legs shortest = Legs::shortest(a, b);
  if (shortest == straight || on_sphere_) return shortest;
  std::vector<Point<2>> points{a, b, straight.middle(), shortest.middle()};
  forward_->apply(points);
  const Point<2> middle = middle_of<2>(points[0], points[1]);
  const bool is_straight = distance<2>(middle, points[2]) <= distance<2>(middle, points[3]);
  return is_straight ? straight : shortest;
}

double Projection::off_way(const Point<2>& point, const Point<2>& a, const Point<2>& b) const {
  if (!forward_) return 0;
  if (on_sphere_ && wraps_) return off_great_circle(point, a, b);
  std::vector<Point<2>> points{point, a, b};
  forward_->apply(points);
  const Point<2>&here = points[0], &from = points[1], &to = points[2];
  const Point<2> way{to[0] - from[0], to[1] - from[1]}, across{-way[1], way[0]};
  const double near = std::min(distance<2>(here, from), distance<2>(here, to)), whole = length(way);
  return near > 0 && whole > 0
             ? std::fabs(dot(across, {here[0] - from[0], here[1] - from[1]})) / whole / near
             : 0;
}

std::optional<Projection::Fault> Projection::project(std::vector<Point<2>>& points) const {
  if (!forward_) return std::nullopt;
  std::vector<Point<2>> back = points;
  const std::string reason = forward_->apply(back);
  for (std::size_t i = 0; i < back.size(); ++i)
    if (!std::isfinite(back[i][0]) || !std::isfinite(back[i][1])) return Fault{i, reason};
  points.swap(back);
  std::vector<Point<2>>& given = back;
  std::vector<Point<2>> returned = points;
  backward_->apply(returned);
  restore_poles(points, returned);
  if (!wraps_) return std::nullopt;
  // Far outside its range of validity a projection may return the point of another place.
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double shrink = std::max(std::cos(given[i][1] * radian), 1e-9);
    const double off =
        std::max(std::fabs(std::remainder(returned[i][0] - given[i][0], 360)) * shrink,
                 std::fabs(returned[i][1] - given[i][1]));
    if (!(off <= same_degrees))
      return Fault{i, "the inverse projection returns " + point_text(returned[i])};
  }
  return std::nullopt;
}

Projection::Scale Projection::scale_at(const std::vector<Point<2>>& points) const {
  Scale scale;
  if (!degrees_ || target_.is_geographic() || points.empty()) return scale;
  std::vector<Point<2>> centres;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / scale_samples)
    centres.push_back(points[i]);
  degrees_->apply(centres);
  std::vector<Point<2>> around;
  for (const auto& [longitude, latitude] : centres)
    for (const double step : {-scale_step, scale_step}) {
      around.push_back({longitude + step, latitude});
      around.push_back({longitude, latitude + step});
    }
  of_degrees_->apply(around);
  const double metres = OSRGetLinearUnits(target_.get(), nullptr);
  const double a = OSRGetSemiMajor(target_.get(), nullptr),
               b = OSRGetSemiMinor(target_.get(), nullptr);
  scale = {HUGE_VAL, 0};
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double c = std::cos(centres[i][1] * radian), s = std::sin(centres[i][1] * radian);
    if (c < 1e-3) continue;  // parallels degenerate at a pole
    // Radii of curvature of the parallel and of the meridian.
    const double w = std::sqrt(a * a * c * c + b * b * s * s);
    const double radii[2] = {a * a / w * c, a * a * b * b / (w * w * w)};
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      const Point<2>&low = around[4 * i + k], &high = around[4 * i + 2 + k];
      const double length = std::hypot(high[0] - low[0], high[1] - low[1]) * metres;
      const double ratio = length / (2 * scale_step * radian * radii[k]);
      if (!std::isfinite(ratio)) continue;
      scale.least = std::min(scale.least, ratio);
      scale.greatest = std::max(scale.greatest, ratio);
    }
  }
  return scale.greatest > 0 ? scale : Scale{};
}

void Projection::to_degrees(std::vector<Point<2>>& points) const {
  if (!degrees_)
    throw Error(ErrorKind::state,
                "the coordinates of the file are in no reference system of the Earth");
  const std::vector<Point<2>> projected = points;
  degrees_->apply(points);
  restore_poles(projected, points);
}

void Projection::from_degrees(std::vector<Point<2>>& points) const {
  if (!of_degrees_)
    throw Error(ErrorKind::state,
                "the coordinates of the file are in no reference system of the Earth");
  of_degrees_->apply(points);
}

}  // namespace pnpbs::geo
