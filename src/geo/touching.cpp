// SPDX-License-Identifier: BSD-3-Clause
#include "geo/touching.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace pnpbs::geo {
namespace {

using Place = std::int64_t;

// Distance at which a vertex is on a segment. If the layer extends over 10 degrees, it is a
// millimetre, which covers rounding. [extent of the layer]
constexpr double on_it = 1e-9;

// Width up to which an outline encloses nothing. [length]
constexpr double spike = 1e-3;

// A grid of cells with the vertices in them. Vertices for which `is_meant` is 0 are left out.
class PlaceGrid {
 public:
  PlaceGrid(const std::vector<Point<2>>& points, const std::vector<char>& is_meant) {
    high_ = low_ = points.front();
    for (const Point<2>& point : points)
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        low_[k] = std::min(low_[k], point[k]);
        high_[k] = std::max(high_[k], point[k]);
      }
    const double cells = std::sqrt(static_cast<double>(points.size()));
    side_ = static_cast<std::int64_t>(std::clamp(cells, 1.0, 4096.0));
    begin_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
    const auto count = static_cast<Place>(points.size());
    for (Place p = 0; p < count; ++p)
      if (is_meant[p]) ++begin_[cell_of(points[p]) + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    places_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (Place p = 0; p < count; ++p)
      if (is_meant[p]) places_[next[cell_of(points[p])]++] = p;
  }

  double extent() const { return std::max(high_[0] - low_[0], high_[1] - low_[1]); }

  // Calls visit(vertex) for all vertices within `reach` of the segment, and for some others.
  template <class Visit>
  void for_places_near(const Point<2>& a, const Point<2>& b, double reach,
                       const Visit& visit) const {
    const Point<2>&left = a[0] <= b[0] ? a : b, &right = a[0] <= b[0] ? b : a;
    const double width = right[0] - left[0];
    const std::int64_t last = index(right[0] + reach, 0);
    for (std::int64_t column = index(left[0] - reach, 0); column <= last; ++column) {
      double y0 = left[1], y1 = right[1];
      if (width > 0) {
        const double slope = (right[1] - left[1]) / width;
        const auto at = [&](double x) {
          return left[1] + slope * (std::clamp(x, left[0], right[0]) - left[0]);
        };
        y0 = at(border(column) - reach);
        y1 = at(border(column + 1) + reach);
      }
      const std::int64_t top = index(std::max(y0, y1) + reach, 1);
      for (std::int64_t row = index(std::min(y0, y1) - reach, 1); row <= top; ++row) {
        const auto cell = static_cast<std::size_t>(column * side_ + row);
        for (std::size_t k = begin_[cell]; k < begin_[cell + 1]; ++k) visit(places_[k]);
      }
    }
  }

 private:
  double border(std::int64_t column) const {
    return low_[0] +
           (high_[0] - low_[0]) * (static_cast<double>(column) / static_cast<double>(side_));
  }
  std::int64_t index(double x, std::size_t k) const {
    const double width = high_[k] - low_[k];
    const double cell = width > 0 ? (x - low_[k]) / width * static_cast<double>(side_) : 0;
    return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(side_ - 1)));
  }
  std::size_t cell_of(const Point<2>& point) const {
    return static_cast<std::size_t>(index(point[0], 0) * side_ + index(point[1], 1));
  }

  Point<2> low_, high_;
  std::int64_t side_ = 1;
  std::vector<std::size_t> begin_;
  std::vector<Place> places_;
};

// Returns the position of the nearest point on the line through a and b (0 at a, 1 at b), and the
// distance from it.
std::pair<double, double> foot_of(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], square = ux * ux + uy * uy;
  if (square == 0) return {0, HUGE_VAL};
  const double t = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / square;
  return {t, std::hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy)};
}

// The search for vertices that lie on segments of routes.
class Splitter {
 public:
  Splitter(std::vector<Route>& routes, const std::vector<Point<2>>& points,
           const Projection& projection)
      : routes_(routes),
        points_(points),
        projection_(projection),
        feature_(points.size(), -1),
        last_route_(points.size(), nullptr) {
    std::vector<char> in_routes(points.size(), 0);
    for (const Route& route : routes)
      for (const Place place : route.places) {
        if (!in_routes[place]) feature_[place] = route.feature;
        in_routes[place] = 1;
      }
    grid_.emplace(points, in_routes);
    list_pairs();
  }

  std::optional<NearMiss> run() {
    for (Route& route : routes_) route.places = split(route);
    return near_miss_;
  }

 private:
  static std::pair<Place, Place> pair_of(Place a, Place b) { return std::minmax(a, b); }

  static std::size_t segments_of(const Route& route) {
    if (route.places.empty()) return 0;
    return route.kind == PathKind::line ? route.places.size() - 1 : route.places.size();
  }

  void list_pairs() {
    for (const Route& route : routes_)
      for (std::size_t s = 0; s < segments_of(route); ++s) {
        const Place a = route.places[s], b = route.places[(s + 1) % route.places.size()];
        if (a != b) pairs_.push_back(pair_of(a, b));
      }
    std::sort(pairs_.begin(), pairs_.end());
  }

  bool is_shared(Place a, Place b) const {
    const auto [first, last] = std::equal_range(pairs_.begin(), pairs_.end(), pair_of(a, b));
    return last - first > 1;
  }

  std::vector<Place> split(const Route& route) {
    for (const Place place : route.places) last_route_[place] = &route;
    std::vector<Place> places;
    for (std::size_t s = 0; s < segments_of(route); ++s) {
      const Place a = route.places[s], b = route.places[(s + 1) % route.places.size()];
      places.push_back(a);
      if (a == b || is_shared(a, b)) continue;
      for (const Place stop : stops_on(a, b, route)) places.push_back(stop);
    }
    if (route.kind == PathKind::line && !route.places.empty())
      places.push_back(route.places.back());
    return places;
  }

  bool is_at(Place place, Place end) const {
    return distance<2>(points_[place], points_[end]) <= on_it * grid_->extent();
  }

  // Returns whether the route encloses an area between the vertex and the segment. An outline may
  // follow a parallel and return on the projected segment, which is another way.
  bool encloses_an_area(Place place, Place a, Place b, const Route& route) const {
    return last_route_[place] == &route &&
           projection_.off_way(points_[place], points_[a], points_[b]) > spike;
  }

  std::vector<Place> stops_on(Place a, Place b, const Route& route) {
    std::vector<std::tuple<const Leg*, double, Place>> stops;
    const double extent = grid_->extent();
    const Legs legs = projection_.legs_of(points_[a], points_[b]);
    for (const Leg& leg : legs)
      grid_->for_places_near(leg.from, leg.to, nearly_on_it * extent, [&](Place place) {
        if (place == a || place == b) return;
        const auto [t, distance] = foot_of(points_[place], leg.from, leg.to);
        if (!(t > 0 && t < 1) || distance > nearly_on_it * extent) return;
        // A vertex very near an end would leave a tiny segment.
        const bool at_end = is_at(place, a) || is_at(place, b);
        if (distance <= on_it * extent && !at_end) {
          if (!encloses_an_area(place, a, b, route)) stops.push_back({&leg, t, place});
        } else if (!near_miss_ && feature_[place] != route.feature)
          near_miss_ = NearMiss{place, feature_[place], route.feature};
      });
    std::sort(stops.begin(), stops.end());
    std::vector<Place> places;
    for (const auto& [leg, t, place] : stops) places.push_back(place);
    return places;
  }

  std::vector<Route>& routes_;
  const std::vector<Point<2>>& points_;
  const Projection& projection_;
  std::vector<std::int64_t> feature_;     // feature of each vertex
  std::vector<const Route*> last_route_;  // latest route with each vertex
  std::optional<PlaceGrid> grid_;
  std::vector<std::pair<Place, Place>> pairs_;
  std::optional<NearMiss> near_miss_;
};

}  // namespace

std::optional<NearMiss> split_where_touched(std::vector<Route>& routes,
                                            const std::vector<Point<2>>& points,
                                            const Projection& projection) {
  if (routes.empty() || points.empty()) return std::nullopt;
  return Splitter(routes, points, projection).run();
}

}  // namespace pnpbs::geo
