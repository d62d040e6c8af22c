// SPDX-License-Identifier: BSD-3-Clause
#include "geo/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "geo/library_error.hpp"
#include "geo/open_boundaries.hpp"
#include "geo/touching.hpp"
#include "geometry/plane/segments.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::geo {
namespace {

std::vector<Point<2>> all_points(const LayerShapes& layer) {
  std::vector<Point<2>> points;
  for (const Path& path : layer.paths)
    points.insert(points.end(), path.points.begin(), path.points.end());
  for (const Spot& spot : layer.spots) points.push_back(spot.point);
  return points;
}

ErrorKind kind_of(pnpbs_status status) {
  switch (status) {
    case PNPBS_ERROR_HANDLE:
      return ErrorKind::handle;
    case PNPBS_ERROR_STATE:
      return ErrorKind::state;
    case PNPBS_ERROR_MEMORY:
      return ErrorKind::memory;
    case PNPBS_ERROR_DOMAIN:
      return ErrorKind::domain;
    default:
      return ErrorKind::argument;
  }
}

void check(pnpbs_status status, pnpbs_context context) {
  if (status < 0) throw Error(kind_of(status), last_message(context));
}

// Difference of the scale from 1 above which a note is given. [1]
constexpr double scale_note_threshold = 0.02;

// Distance from the boundary up to which a line follows it. A line that is drawn on a screen which
// shows the whole layer is off by about a pixel. [extent of the layer]
constexpr double follow_tolerance = 1e-3;

// Advice for neighbours that almost touch.
constexpr const char* same_vertices =
    "give the same vertices to the edge between them "
    "(docs/guide/shapes.md, 'Neighbours that do not fit')";

double extent_of(const std::vector<Point<2>>& points) {
  Point<2> low = points.front(), high = low;
  for (const Point<2>& point : points)
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  return std::max(high[0] - low[0], high[1] - low[1]);
}

}  // namespace

Shapes::Shapes(const Request& request)
    : layer_(read_layer(request.path, request.layer, request.tag_field, request.region_field)),
      projection_(layer_.system, all_points(layer_), request.projection, request.unit) {
  project();
  if (!request.region_field.empty()) find_regions();
  take_notes();
}

MessageText Shapes::words_for(const Point<2>& given, std::int64_t feature) const {
  return layer_.name + ": feature " + std::to_string(feature) + ": " + point_text(given);
}

// Returns the layer and feature of a curve for messages. If the curve begins where a line along the
// boundary ends, its first vertex belongs to no feature.
std::string Shapes::words_for(const Curve& curve) const {
  const auto place = static_cast<std::size_t>(curve.places.front());
  if (place >= feature_of_place_.size()) return layer_.name + ": ";
  return layer_.name + ": feature " + std::to_string(feature_of_place_[place]) + ": ";
}

void Shapes::project() {
  Places given;
  std::vector<Route> routes;
  std::vector<std::int64_t> features;  // feature in which each vertex first appears
  const auto number_of = [&](const Point<2>& point, std::int64_t feature) {
    const std::int64_t number = given.add(projection_.canonical(point));
    if (number == static_cast<std::int64_t>(features.size())) features.push_back(feature);
    return number;
  };
  for (Path& path : layer_.paths) {
    Route route{path.kind, path.feature, path.tag, {}};
    for (const Point<2>& point : path.points)
      route.places.push_back(number_of(point, path.feature));
    routes.push_back(std::move(route));
    path.points = {};
  }
  std::vector<std::int64_t> spots;
  for (const Spot& spot : layer_.spots) spots.push_back(number_of(spot.point, spot.feature));

  if (const auto miss = split_where_touched(routes, given.points(), projection_))
    layer_.notes.emplace_back(
        NoteCode::nearly_touching,
        "features " + std::to_string(miss->feature) + " and " + std::to_string(miss->other) +
            " almost touch at " + point_text(given.points()[miss->place]) +
            " (and maybe elsewhere): if they are neighbours, " + same_vertices,
        2);
  std::vector<Point<2>> projected = given.points();
  if (const auto fault = projection_.project(projected))
    throw Error(ErrorKind::file, words_for(given.points()[fault->index], features[fault->index]) +
                                     " cannot be projected to '" + projection_.system().name() +
                                     "': " + fault->reason);
  Places places;
  std::vector<std::int64_t> place_of;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    place_of.push_back(places.add(projected[k]));
    const bool is_new = place_of.back() == std::ssize(feature_of_place_);
    if (is_new) feature_of_place_.push_back(features[k]);
  }
  for (Route& route : routes)
    for (std::int64_t& place : route.places) place = place_of[place];
  for (std::size_t s = 0; s < spots.size(); ++s) layer_.spots[s].point = projected[spots[s]];
  places_ = places.points();
  const double extent = on_sphere()       ? 2 * projection_.sphere_radius()
                        : places_.empty() ? 0
                                          : extent_of(places_);
  scale_ = projection_.scale_at(places_);
  const auto where = [&](std::int64_t place) { return with_degrees(point_text(places_[place])); };
  routes_ = routes;
  outlines_ = outlines_of(std::move(routes), places_, where, projection_.sphere_radius());
  if (on_sphere()) outlines_.leave_out_shared_edges_outside(places_);
  lines_along_boundary_ =
      retag_open_boundaries(outlines_.curves, places_, follow_tolerance * extent);
}

void Shapes::find_regions() {
  if (on_sphere())
    throw Error(
        ErrorKind::argument,
        "argument region_field: on a sphere polygons cannot be regions; add a point to each "
        "region instead (pnpbs_domain_add_region, --region)");
  if (layer_.regions.empty())
    throw Error(ErrorKind::domain, layer_.name + " has no polygons, which regions consist of");
  const auto where = [&](const Point<2>& point) { return with_degrees(point_text(point)); };
  RegionPoints found = region_points_of(outlines_.curves, routes_, places_, layer_.regions, where);
  region_points_ = std::move(found.points);
  if (const auto& gap = found.gap) {
    const MessageText have_gap = "features " + std::to_string(gap->feature) + " and " +
                                 std::to_string(gap->other) + " have a gap of " +
                                 rounded_text(gap->width) + " between them at " +
                                 where(gap->point) + " (and maybe elsewhere)";
    if (gap->width < nearly_on_it * extent_of(places_))
      throw Error(ErrorKind::domain, have_gap + ": " + same_vertices);
    layer_.notes.emplace_back(
        NoteCode::nearly_touching,
        have_gap + ", which is outside of the domain: if they are neighbours, " + same_vertices, 2);
  }
}

void Shapes::take_notes() {
  std::vector<Note>& notes = layer_.notes;
  if (!layer_.system)
    notes.emplace_back(
        NoteCode::no_reference_system,
        "the file has no coordinate reference system (such as a .prj beside it): its coordinates "
        "are taken as x and y in a plane");
  if (projection_.is_identity() && projection_.system().is_geographic())
    notes.emplace_back(NoteCode::degrees_in_plane,
                       "longitude and latitude are taken as x and y in a plane, as requested");
  if (!on_sphere() &&
      (scale_.least < 1 - scale_note_threshold || scale_.greatest > 1 + scale_note_threshold))
    notes.emplace_back(NoteCode::scale,
                       "in the projection '" + projection_.system().name() + "' lengths are " +
                           rounded_text(scale_.least) + " to " + rounded_text(scale_.greatest) +
                           " times what they are on the Earth, and d is meant in the projection");
  if (outlines_.retagged_edges > 0)
    notes.emplace_back(
        NoteCode::segments_retagged,
        std::to_string(outlines_.retagged_edges) +
            " segments of polygons have the tag of the line that coincides with them",
        outlines_.retagged_edges);
  if (lines_along_boundary_ == 1)
    notes.emplace_back(
        NoteCode::lines_along_boundary,
        "a line runs along the boundary, to 0.001 of the extent: that part of the boundary has its "
        "tag, and the line is not a separate curve",
        1);
  else if (lines_along_boundary_ > 1)
    notes.emplace_back(NoteCode::lines_along_boundary,
                       std::to_string(lines_along_boundary_) +
                           " lines run along the boundary, to 0.001 of the extent: these parts of "
                           "the boundary have their tags, and the lines are not separate curves",
                       lines_along_boundary_);
  if (outlines_.outer_edges > 0)
    notes.emplace_back(NoteCode::shared_segments_left_out,
                       std::to_string(outlines_.outer_edges) +
                           " segments that neighbouring polygons share were left out: the domain "
                           "is outside of the polygons",
                       outlines_.outer_edges);
  if (on_sphere() && boundary_curves() == 0)
    notes.emplace_back(NoteCode::whole_sphere,
                       "no polygon and no closed line bounds the domain: it is the whole sphere");
  if (outlines_.lost_tags > 0)
    notes.emplace_back(NoteCode::lines_left_out,
                       "lines left out: " + std::to_string(outlines_.lost_tags) +
                           " segments that coincide with those of a line with another tag",
                       outlines_.lost_tags);
  if (outlines_.dropped_edges > 0)
    notes.emplace_back(NoteCode::segments_left_out,
                       std::to_string(outlines_.dropped_edges) +
                           " segments were left out that repeat others or are traversed in both "
                           "directions within a feature, as along 180 degrees",
                       outlines_.dropped_edges);
}

// ------------------------------------------------------------------ conversion to a domain ------
void Shapes::add_to(pnpbs_domain domain, pnpbs_context context, double corner_angle) const {
  std::int32_t dimension = 0;
  check(pnpbs_domain_dimension(domain, &dimension), context);
  if (dimension != (on_sphere() ? 3 : 2))
    throw Error(ErrorKind::argument,
                on_sphere()
                    ? "argument domain: the shapes were read for a domain on a sphere"
                    : "argument domain: the shapes were read for a domain in the plane, and "
                      "this one is in space; for a domain on a sphere name the projection "
                      "sphere(LONGITUDE,LATITUDE)");
  if (!(corner_angle >= 0 && corner_angle <= 180))
    throw Error(ErrorKind::argument, "argument corner_angle is " + number_text(corner_angle) +
                                         ", expected degrees from 0 to 180");
  for (const auto& [tag, name] : layer_.tag_names)
    check(pnpbs_domain_set_tag_name(domain, 1, tag, name.c_str()), context);
  for (const auto& [tag, name] : layer_.region_names)
    check(pnpbs_domain_set_tag_name(domain, 2, tag, name.c_str()), context);
  add_curves(domain, context, corner_angle);
  for (const RegionPoint& region : region_points_in(domain, context))
    check(pnpbs_domain_add_region(domain, region.point.data(), region.tag), context);
  std::vector<Point<2>> points;
  std::vector<std::int32_t> tags;
  for (const Spot& spot : layer_.spots) {
    points.push_back(spot.point);
    tags.push_back(spot.tag);
  }
  if (points.empty()) return;
  const std::vector<double> coordinates = coordinates_of(points);
  check(pnpbs_domain_add_fixed_nodes(domain, std::ssize(points), coordinates.data(), tags.data()),
        context);
}

void Shapes::add_curves(pnpbs_domain domain, pnpbs_context context, double corner_angle) const {
  std::vector<Point<2>> points;
  for (const Curve& curve : outlines_.curves) {
    points.clear();
    for (const std::int64_t place : curve.places) points.push_back(places_[place]);
    const std::vector<double> coordinates = coordinates_of(points);
    const pnpbs_status status = pnpbs_domain_add_polyline(
        domain, curve.bounds ? PNPBS_BOUNDARY : PNPBS_INNER, curve.closed, std::ssize(points),
        coordinates.data(), curve.tags.data(), corner_angle);
    if (status < 0) throw Error(kind_of(status), words_for(curve) + last_message(context));
  }
}

// Returns the points in regions. If the domain splits curves where they cross
// (pnpbs_domain_set_fragment), there are more of them than between the curves of the layer.
std::vector<RegionPoint> Shapes::region_points_in(pnpbs_domain domain,
                                                  pnpbs_context context) const {
  if (region_points_.empty()) return {};
  std::int64_t given = 0, count = 0;
  for (const Curve& curve : outlines_.curves)
    given += static_cast<std::int64_t>(segments_of(curve));
  // The domain may not be complete yet, or is invalid, which a later check reports.
  if (pnpbs_domain_get_segments(domain, 0, &count, nullptr, nullptr) < 0 || count == given)
    return region_points_;
  std::vector<double> ends(static_cast<std::size_t>(4 * count));
  check(pnpbs_domain_get_segments(domain, count, &count, ends.data(), nullptr), context);
  std::vector<Point<2>> points = places_;
  std::vector<Curve> segments;
  for (std::size_t k = 0; k < ends.size(); k += 4) {
    // Points are sought beside the middle of the longer part of each segment. Lines of maps often
    // have vertices at simple fractions of others, on which such a point could lie.
    constexpr double kPart = 0.41421356;
    const std::int64_t first = std::ssize(points);
    const Point<2> a{ends[k], ends[k + 1]}, b{ends[k + 2], ends[k + 3]};
    points.push_back(a);
    points.push_back({a[0] + kPart * (b[0] - a[0]), a[1] + kPart * (b[1] - a[1])});
    points.push_back(b);
    segments.push_back({false, false, {first, first + 1, first + 2}, {1, 1}, true});
  }
  const auto where = [&](const Point<2>& point) { return with_degrees(point_text(point)); };
  return region_points_of(segments, routes_, points, layer_.regions, where).points;
}

// Returns the coordinates in the form that a domain takes: [points][2], or [points][3] on a sphere.
std::vector<double> Shapes::coordinates_of(std::vector<Point<2>> points) const {
  if (on_sphere()) projection_.to_degrees(points);
  std::vector<double> coordinates;
  for (const Point<2>& point : points)
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  if (!on_sphere()) return coordinates;
  std::vector<double> in_space(3 * points.size());
  check(pnpbs_sphere_points(1, std::ssize(points), coordinates.data(), in_space.data()), nullptr);
  return in_space;
}

// ------------------------------------------------------------------ properties ------------------
std::int64_t Shapes::vertices() const { return static_cast<std::int64_t>(places_.size()); }

std::int64_t Shapes::boundary_curves() const {
  return std::ranges::count_if(outlines_.curves, [](const Curve& curve) { return curve.bounds; });
}

std::int64_t Shapes::inner_curves() const {
  return static_cast<std::int64_t>(outlines_.curves.size()) - boundary_curves();
}

// ------------------------------------------------------------------ messages --------------------
namespace {

template <class Words>
MessageText with_words_after_points(const MessageText& message, const Words& words) {
  return with_points_replaced(
      message,
      [&](const NamedPoint& point, const std::string& text) { return text + words(point); },
      [](const NamedPoint& point) { return point; });
}

template <class Visit>
void for_segments(const Route& route, const Visit& visit) {
  const std::size_t count = route.places.size();
  for (std::size_t k = route.kind == PathKind::line ? 1 : 0; k < count; ++k)
    visit(route.places[k == 0 ? count - 1 : k - 1], route.places[k]);
}

}  // namespace

// Returns longitude and latitude in brackets, or "" if the point is not projected.
std::string Shapes::degrees_for(const NamedPoint& point) const {
  const ReferenceSystem& system = projection_.system();
  if (!system || system.is_geographic() || point.dimension != 2) return "";
  std::vector<Point<2>> degrees{{point.x[0], point.x[1]}};
  projection_.to_degrees(degrees);
  if (!std::isfinite(degrees[0][0] + degrees[0][1])) return "";
  return " [" + degrees_text(degrees[0]) + "]";
}

MessageText Shapes::with_degrees(const MessageText& message) const {
  return with_words_after_points(message,
                                 [this](const NamedPoint& point) { return degrees_for(point); });
}

// Returns one route of each feature that has a segment at the point.
std::vector<const Route*> Shapes::routes_at(const NamedPoint& point) const {
  Point<2> x{point.x[0], point.x[1]};
  double sag = 0;  // of great circles in the projection [length of a segment]
  if (on_sphere() && point.dimension == 3) {
    std::vector<Point<2>> projected{degrees_of(point.x)};
    projection_.from_degrees(projected);
    x = projected[0];
    sag = 1e-3;
  } else if (on_sphere() || point.dimension != 2) {
    return {};
  }
  constexpr double rounding = 1e-9;  // [extent]
  const double same = rounding * extent_of(places_);
  std::vector<const Route*> routes;
  for (const Route& route : routes_) {
    bool is_at = false;
    for_segments(route, [&](std::int64_t begin, std::int64_t end) {
      const Point<2>&a = places_[begin], &b = places_[end];
      is_at = is_at || distance_to_segment(a, b, x) <= same + sag * distance<2>(a, b);
    });
    const bool is_known = std::ranges::any_of(
        routes, [&](const Route* other) { return other->feature == route.feature; });
    if (is_at && !is_known) routes.push_back(&route);
  }
  return routes;
}

// Returns the features of the routes with the names of their tags, such as " (feature 3 'shore')".
std::string Shapes::features_text(const std::vector<const Route*>& routes) const {
  if (routes.empty()) return "";
  std::vector<std::string> features;
  for (const Route* route : routes) {
    const auto name = layer_.tag_names.find(route->tag);
    features.push_back("feature " + std::to_string(route->feature) +
                       (name == layer_.tag_names.end() ? "" : " '" + name->second + "'"));
  }
  return " (" + list_text(features, 4) + ")";
}

// Returns whether two of the polygons have two common vertices or more.
bool Shapes::are_neighbours(const std::vector<const Route*>& routes) const {
  std::vector<std::int64_t> places, common;
  for (const Route* at : routes) {
    std::vector<std::int64_t> own;
    for (const Route& route : routes_)
      if (route.feature == at->feature)
        own.insert(own.end(), route.places.begin(), route.places.end());
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    places.insert(places.end(), own.begin(), own.end());
  }
  std::ranges::sort(places);
  for (std::size_t k = 1; k < places.size(); ++k)
    if (places[k] == places[k - 1]) common.push_back(places[k]);
  return common.size() > 1;
}

std::string Shapes::advice_on_crossing(const NamedPoint& point) const {
  const std::vector<const Route*> routes = routes_at(point);
  if (std::ranges::any_of(routes, [](const Route* at) { return at->kind == PathKind::line; }))
    return on_sphere()
               ? "Give lines a common vertex where they cross: docs/guide/shapes.md, 'Lines that "
                 "cross'"
               : "Let --fragment (pnpbs_domain_set_fragment) split lines where they cross, or give "
                 "them a common vertex there: docs/guide/shapes.md, 'Lines that cross'";
  if (!layer_.regions.empty() && routes.size() > 1)
    return "Regions must not overlap: subtract one polygon from the other, or give both the same "
           "vertices on their common edge: docs/guide/shapes.md, 'Neighbours that do not fit'";
  if (are_neighbours(routes))
    return "Give neighbouring polygons the same vertices on their common edge: "
           "docs/guide/shapes.md, 'Neighbours that do not fit'";
  return "Unite crossing polygons first: docs/guide/shapes.md, 'Polygons that cross'";
}

std::string Shapes::explained(const std::string& text, const MessageText& last) const {
  const MessageText of_domain = last_message(nullptr);
  for (const MessageText* known : {&last, &of_domain}) {
    const std::size_t at = known->empty() ? std::string::npos : text.find(known->text());
    if (at == std::string::npos) continue;
    // Messages of this library name features already.
    const auto words = [&](const NamedPoint& point) {
      return degrees_for(point) + (known == &last ? "" : features_text(routes_at(point)));
    };
    std::string told = with_words_after_points(*known, words).text();
    if (known == &of_domain && last_error_is_crossing() && !known->points().empty())
      told += "\n" + advice_on_crossing(known->points().front());
    return text.substr(0, at) + told + text.substr(at + known->text().size());
  }
  return text;
}

}  // namespace pnpbs::geo
