// SPDX-License-Identifier: BSD-3-Clause
#include "geo/region_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"

namespace pnpbs::geo {
namespace {

// Width up to which a strip between two polygons is a gap. [length of its longest segment]
constexpr double gap_width = 1e-2;

// A segment of a curve or an edge of a polygon.
struct Segment {
  Point<2> a, b;
  std::int64_t feature;  // of an edge of a polygon
};

// Segments in rows along a line, for the crossings of segments with parallels to the other axis.
class Rows {
 public:
  // `along`: the axis of the rows. A row is an interval of the other coordinate.
  Rows(const std::vector<Segment>& segments, std::size_t along)
      : segments_(segments), along_(along), across_(1 - along) {
    if (segments.empty()) return;
    double high = -HUGE_VAL;
    for (const Segment& segment : segments)
      for (const Point<2>& end : {segment.a, segment.b}) {
        low_ = std::min(low_, end[across_]);
        high = std::max(high, end[across_]);
      }
    const double count = std::sqrt(static_cast<double>(segments.size()));
    rows_.resize(static_cast<std::size_t>(std::clamp(count, 1.0, 4096.0)));
    height_ = (high - low_) / static_cast<double>(rows_.size());
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto [first, last] = std::minmax(segments[s].a[across_], segments[s].b[across_]);
      for (std::size_t row = row_of(first); row <= row_of(last); ++row) rows_[row].push_back(s);
    }
  }

  // Calls visit(index, coordinate) for all segments that cross the parallel at `level`.
  template <class Visit>
  void for_crossings(double level, const Visit& visit) const {
    if (rows_.empty()) return;
    for (const std::size_t s : rows_[row_of(level)]) {
      const Point<2>&a = segments_[s].a, &b = segments_[s].b;
      if ((a[across_] > level) == (b[across_] > level)) continue;
      visit(s,
            a[along_] + (level - a[across_]) / (b[across_] - a[across_]) * (b[along_] - a[along_]));
    }
  }

 private:
  std::size_t row_of(double level) const {
    const double row = height_ > 0 ? (level - low_) / height_ : 0;
    return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(rows_.size() - 1)));
  }

  const std::vector<Segment>& segments_;
  std::size_t along_, across_;
  double low_ = HUGE_VAL, height_ = 0;
  std::vector<std::vector<std::size_t>> rows_;
};

std::vector<Segment> segments_of(const std::vector<Curve>& curves,
                                 const std::vector<Point<2>>& points) {
  std::vector<Segment> segments;
  for (const Curve& curve : curves)
    for (std::size_t s = 0; s < segments_of(curve); ++s)
      segments.push_back({points[curve.places[s]], points[end_of(curve, s)], -1});
  return segments;
}

std::vector<Segment> edges_of_polygons(const std::vector<Route>& routes,
                                       const std::vector<Point<2>>& points) {
  std::vector<Segment> edges;
  for (const Route& route : routes) {
    if (route.kind == PathKind::line) continue;
    for (std::size_t k = 0; k < route.places.size(); ++k)
      edges.push_back({points[route.places[k]], points[route.places[(k + 1) % route.places.size()]],
                       route.feature});
  }
  return edges;
}

// The search for points beside curves.
class Search {
 public:
  Search(const std::vector<Curve>& curves, const std::vector<Route>& routes,
         const std::vector<Point<2>>& points, const std::map<std::int64_t, std::int32_t>& tags,
         const std::function<MessageText(const Point<2>&)>& where)
      : curves_(curves),
        tags_(tags),
        where_(where),
        segments_(segments_of(curves, points)),
        edges_(edges_of_polygons(routes, points)) {
    for (const Segment& edge : edges_) {
      auto& [low, high] = boxes_.try_emplace(edge.feature, edge.a, edge.a).first->second;
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        low[k] = std::min({low[k], edge.a[k], edge.b[k]});
        high[k] = std::max({high[k], edge.a[k], edge.b[k]});
      }
    }
  }

  RegionPoints run() {
    std::size_t first = 0;
    for (const Curve& curve : curves_) {
      const std::size_t end = first + geo::segments_of(curve);
      std::size_t longest = first;
      for (std::size_t s = first; s < end; ++s) {
        if (length_of(s) > length_of(longest)) longest = s;
        if (curve.bounds && !curve.of_line) find_gap(ray_through(s));
      }
      add_points(ray_through(longest));
      first = end;
    }
    return std::move(found_);
  }

 private:
  // The crossings of segments with a parallel to an axis through the middle of a segment, from
  // there in both directions.
  struct Ray {
    std::size_t along;  // the axis to which the segment is steeper
    double level, here, length;
    // The two nearest crossings, downwards and upwards. Infinite if there are fewer.
    std::array<std::array<double, 2>, 2> beyond{{{-HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL}}};

    Point<2> point_between(double from, double to) const {
      Point<2> point;
      point[along] = std::midpoint(from, to);
      point[1 - along] = level;
      return point;
    }
  };

  double length_of(std::size_t s) const { return distance<2>(segments_[s].a, segments_[s].b); }

  Ray ray_through(std::size_t segment) const {
    const Point<2>&a = segments_[segment].a, &b = segments_[segment].b;
    Ray ray;
    ray.along = std::fabs(b[1] - a[1]) >= std::fabs(b[0] - a[0]) ? 0 : 1;
    ray.level = std::midpoint(a[1 - ray.along], b[1 - ray.along]);
    ray.here = std::midpoint(a[ray.along], b[ray.along]);
    ray.length = length_of(segment);
    segment_rows_[ray.along].for_crossings(ray.level, [&](std::size_t s, double at) {
      if (s == segment || at == ray.here) return;
      auto& [nearest, next] = ray.beyond[at > ray.here];
      const auto nearer = [&](double than) { return (at > ray.here) == (at < than); };
      if (nearer(nearest))
        next = nearest, nearest = at;
      else if (nearer(next))
        next = at;
    });
    return ray;
  }

  // Adds the points in the middle between a segment and the next ones on both of its sides that lie
  // in a polygon.
  void add_points(const Ray& ray) {
    for (const std::array<double, 2>& beyond : ray.beyond) {
      if (std::isinf(beyond[0])) continue;
      const Point<2> point = ray.point_between(ray.here, beyond[0]);
      const auto feature = feature_at(point, ray.along);
      if (!feature) continue;
      if (const std::int32_t tag = tags_.at(*feature)) found_.points.push_back({point, tag});
    }
  }

  // Stores the strip beside a segment if it is narrow, lies in no polygon, and has polygons of two
  // features on its sides.
  void find_gap(const Ray& ray) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const std::array<double, 2>&beyond = ray.beyond[side], &behind = ray.beyond[1 - side];
      if (std::isinf(beyond[1]) || std::isinf(behind[0])) continue;
      const double width = std::fabs(beyond[0] - ray.here);
      if (!(width < gap_width * ray.length) || (found_.gap && width >= found_.gap->width)) continue;
      const Point<2> point = ray.point_between(ray.here, beyond[0]);
      const auto one = feature_at(ray.point_between(behind[0], ray.here), ray.along),
                 other = feature_at(ray.point_between(beyond[0], beyond[1]), ray.along);
      if (one && other && *one != *other && !feature_at(point, ray.along))
        found_.gap = Gap{*one, *other, point, width};
    }
  }

  bool may_contain(std::int64_t feature, const Point<2>& point) const {
    const auto& [low, high] = boxes_.at(feature);
    return low[0] < point[0] && point[0] < high[0] && low[1] < point[1] && point[1] < high[1];
  }

  // Returns the feature whose polygons contain the point. Throws Error if there are two.
  std::optional<std::int64_t> feature_at(const Point<2>& point, std::size_t along) const {
    std::vector<std::int64_t> crossed;
    edge_rows_[along].for_crossings(point[1 - along], [&](std::size_t s, double at) {
      if (at < point[along] && may_contain(edges_[s].feature, point))
        crossed.push_back(edges_[s].feature);
    });
    std::sort(crossed.begin(), crossed.end());
    std::vector<std::int64_t> around;
    for (auto begin = crossed.begin(), end = begin; begin != crossed.end(); begin = end) {
      end = std::upper_bound(begin, crossed.end(), *begin);
      if ((end - begin) % 2 != 0) around.push_back(*begin);
    }
    if (around.size() > 1)
      throw Error(ErrorKind::domain,
                  "features " + std::to_string(around[0]) + " and " + std::to_string(around[1]) +
                      " overlap at " + where_(point) +
                      ": with a region field each point must lie in one polygon; subtract one "
                      "from the other, or cut a hole into it");
    if (around.empty()) return std::nullopt;
    return around.front();
  }

  const std::vector<Curve>& curves_;
  const std::map<std::int64_t, std::int32_t>& tags_;
  const std::function<MessageText(const Point<2>&)>& where_;
  std::vector<Segment> segments_, edges_;
  std::unordered_map<std::int64_t, std::pair<Point<2>, Point<2>>> boxes_;  // of each feature
  std::array<Rows, 2> segment_rows_{Rows(segments_, 0), Rows(segments_, 1)},
      edge_rows_{Rows(edges_, 0), Rows(edges_, 1)};
  RegionPoints found_;
};

}  // namespace

RegionPoints region_points_of(const std::vector<Curve>& curves, const std::vector<Route>& routes,
                              const std::vector<Point<2>>& points,
                              const std::map<std::int64_t, std::int32_t>& tags,
                              const std::function<MessageText(const Point<2>&)>& where) {
  return Search(curves, routes, points, tags, where).run();
}

}  // namespace pnpbs::geo
