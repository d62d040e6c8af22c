// SPDX-License-Identifier: BSD-3-Clause
#include "geo/open_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pnpbs::geo {
namespace {

using Place = std::int64_t;

// The nearest point on a segment.
struct Foot {
  double t, distance;  // t: position on the segment, 0 to 1
};

Foot foot_on(const Point<2>& a, const Point<2>& b, const Point<2>& p) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], square = ux * ux + uy * uy;
  const double along = square > 0 ? ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return {t, std::hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy)};
}

// A polyline with a search for the segment near a point. Consecutive points should be near each
// other.
class FollowedLine {
 public:
  explicit FollowedLine(std::vector<Point<2>> points) : points_(std::move(points)) {}

  // Returns whether a segment is within `tolerance`. The search starts at the segment found last.
  bool is_near(const Point<2>& p, double tolerance) {
    const std::size_t segments = points_.size() - 1;
    for (std::size_t k = 0; k < segments; ++k) {
      const std::size_t s = (last_ + k) % segments;
      if (foot_on(points_[s], points_[s + 1], p).distance > tolerance) continue;
      last_ = s;
      return true;
    }
    return false;
  }

 private:
  std::vector<Point<2>> points_;
  std::size_t last_ = 0;
};

// A segment of the boundary.
struct Segment {
  std::size_t curve, index;
  Place a, b;
};

// A point on the boundary. A vertex is represented by t = 0 or 1 on one of its segments.
struct BoundaryPosition {
  std::size_t segment;
  double t;
};

// An interval of a segment that gets a tag.
struct Part {
  double from, to;
  std::int32_t tag;
};

// A line of the file, or a part of it with a single tag.
struct Line {
  std::vector<Place> places;
  std::int32_t tag;
  bool is_closed() const { return places.front() == places.back(); }
};

// The boundary of the domain, on which lines are searched for parts that they follow.
class BoundaryFollower {
 public:
  BoundaryFollower(const std::vector<Curve>& curves, const std::vector<Point<2>>& points,
                   double tolerance)
      : points_(points), tolerance_(tolerance), at_(points.size(), {none, none}) {
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (!curves[c].bounds) continue;
      for (std::size_t s = 0; s < segments_of(curves[c]); ++s)
        segments_.push_back({c, s, curves[c].places[s], end_of(curves[c], s)});
    }
    parts_.resize(segments_.size());
    for (std::size_t s = 0; s < segments_.size(); ++s)
      for (const Place place : {segments_[s].a, segments_[s].b}) note(place, s);
    sort_into_columns();
  }

  // Returns whether the line follows the boundary. If so, that part of the boundary gets its tag.
  bool take(const Line& line) {
    const auto begin = position_near(points_[line.places.front()]);
    const auto end = begin ? position_near(points_[line.places.back()]) : std::nullopt;
    if (!end) return false;
    for (const bool forward : {true, false}) {
      const auto way = way_along(line, *begin, *end, forward);
      if (!way) continue;
      for (const auto& [segment, part] : *way)
        if (part.to > part.from) parts_[segment].push_back(part);
      return true;
    }
    return false;
  }

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Part>& parts_of(std::size_t segment) const { return parts_[segment]; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1), many = none - 1;
  using Way = std::vector<std::pair<std::size_t, Part>>;

  void note(Place place, std::size_t segment) {
    auto& [first, second] = at_[place];
    if (first == none)
      first = segment;
    else
      second = second == none ? segment : many;
  }

  // Sorts segments into columns by x, so that a search for near segments visits few of them.
  void sort_into_columns() {
    if (segments_.empty()) return;
    double high = -HUGE_VAL;
    low_ = HUGE_VAL;
    for (const Segment& segment : segments_)
      for (const Place place : {segment.a, segment.b}) {
        low_ = std::min(low_, points_[place][0]);
        high = std::max(high, points_[place][0]);
      }
    const double count = std::sqrt(static_cast<double>(segments_.size()));
    columns_.resize(static_cast<std::size_t>(std::clamp(count, 1.0, 4096.0)));
    width_ = (high - low_) / static_cast<double>(columns_.size());
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const double a = points_[segments_[s].a][0], b = points_[segments_[s].b][0];
      const std::size_t last = column_of(std::max(a, b) + tolerance_);
      for (std::size_t c = column_of(std::min(a, b) - tolerance_); c <= last; ++c)
        columns_[c].push_back(s);
    }
  }

  std::size_t column_of(double x) const {
    const double column = width_ > 0 ? (x - low_) / width_ : 0;
    return static_cast<std::size_t>(
        std::clamp(column, 0.0, static_cast<double>(columns_.size() - 1)));
  }

  std::optional<BoundaryPosition> position_near(const Point<2>& p) const {
    std::optional<BoundaryPosition> nearest;
    if (columns_.empty()) return nearest;
    double least = tolerance_;
    for (const std::size_t s : columns_[column_of(p[0])]) {
      const Point<2>&a = points_[segments_[s].a], &b = points_[segments_[s].b];
      const Foot foot = foot_on(a, b, p);
      if (foot.distance > least || (nearest && foot.distance == least)) continue;
      least = foot.distance;
      nearest = BoundaryPosition{s, at_vertex(a, b, foot.t)};
    }
    return nearest;
  }

  // Returns t, moved to an end of the segment that is within the tolerance.
  double at_vertex(const Point<2>& a, const Point<2>& b, double t) const {
    const double length = distance<2>(a, b);
    if (std::min(t, 1 - t) * length > tolerance_) return t;
    return t < 0.5 ? 0 : 1;
  }

  Point<2> point_at(const BoundaryPosition& spot) const {
    const Point<2>&a = points_[segments_[spot.segment].a], &b = points_[segments_[spot.segment].b];
    if (spot.t == 0 || spot.t == 1) return spot.t == 0 ? a : b;
    return {a[0] + spot.t * (b[0] - a[0]), a[1] + spot.t * (b[1] - a[1])};
  }

  // Follows the boundary from `begin` to `end` and returns the parts on the way. Returns nothing if
  // the boundary leaves the line, or the line the boundary. `forward`: the way begins towards b of
  // the first segment, else towards its a.
  std::optional<Way> way_along(const Line& line, BoundaryPosition begin,
                               const BoundaryPosition& end, bool forward) const {
    std::vector<Point<2>> line_points, shore{point_at(begin)};
    for (const Place place : line.places) line_points.push_back(points_[place]);
    FollowedLine followed(line_points);
    const Point<2> goal = point_at(end);
    Way way;
    for (std::size_t steps = 0; steps <= segments_.size(); ++steps) {
      const bool ends_ahead = begin.segment == end.segment && (line.is_closed() ? steps > 0
                                                               : forward        ? end.t >= begin.t
                                                                                : end.t <= begin.t);
      const double to = ends_ahead ? end.t : forward ? 1 : 0;
      way.push_back({begin.segment, {std::min(begin.t, to), std::max(begin.t, to), line.tag}});
      shore.push_back(point_at({begin.segment, to}));
      if (ends_ahead || (shore.back() == goal && (steps > 0 || !line.is_closed())))
        return follows(line_points, shore) ? std::optional<Way>(way) : std::nullopt;
      if (!followed.is_near(shore.back(), tolerance_)) return std::nullopt;
      const Segment& segment = segments_[begin.segment];
      const Place place = forward ? segment.b : segment.a;
      const auto& [first, second] = at_[place];
      if (second >= many) return std::nullopt;
      begin.segment = first == begin.segment ? second : first;
      forward = segments_[begin.segment].a == place;
      begin.t = forward ? 0 : 1;
    }
    return std::nullopt;
  }

  bool follows(const std::vector<Point<2>>& line, const std::vector<Point<2>>& shore) const {
    double length = 0;
    for (std::size_t k = 1; k < shore.size(); ++k) length += distance<2>(shore[k - 1], shore[k]);
    if (!(length > 0)) return false;
    FollowedLine followed(shore);
    return std::ranges::all_of(line,
                               [&](const Point<2>& p) { return followed.is_near(p, tolerance_); });
  }

  const std::vector<Point<2>>& points_;
  double tolerance_;
  std::vector<Segment> segments_;
  double low_ = 0, width_ = 0;
  std::vector<std::vector<std::size_t>> columns_;  // segments in each column, by increasing index
  std::vector<std::vector<Part>> parts_;  // parts of each segment; later ones have precedence
  std::vector<std::pair<std::size_t, std::size_t>> at_;  // up to two segments at each vertex
};

// Divides the curve into lines of one tag. A closed curve is divided where its tag changes.
std::vector<Line> lines_of(const Curve& curve) {
  const std::size_t count = segments_of(curve);
  std::size_t first = 0;
  while (curve.closed && first < count &&
         curve.tags[first] == curve.tags[(first + count - 1) % count])
    ++first;
  if (first == count) first = 0;
  std::vector<Line> lines;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t s = (first + k) % count;
    if (lines.empty() || lines.back().tag != curve.tags[s])
      lines.push_back({{curve.places[s]}, curve.tags[s]});
    lines.back().places.push_back(end_of(curve, s));
  }
  return lines;
}

Curve curve_of(const Line& line) {
  Curve curve{false, line.is_closed(), line.places, {}, true};
  if (curve.closed) curve.places.pop_back();
  curve.tags.assign(line.places.size() - 1, line.tag);
  return curve;
}

// Returns the sorted positions on a segment where tags begin or end, including 0 and 1.
std::vector<double> cuts_of(const std::vector<Part>& parts) {
  std::vector<double> cuts{0, 1};
  for (const Part& part : parts) cuts.push_back(part.from), cuts.push_back(part.to);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// The replacement of boundary curves by ones whose segments are split where their tags change.
class BoundaryRebuild {
 public:
  BoundaryRebuild(std::vector<Curve>& curves, std::vector<Point<2>>& points)
      : curves_(curves), points_(points) {}

  void run(const BoundaryFollower& shore) {
    std::vector<Curve> before = curves_;
    for (Curve& curve : curves_)
      if (curve.bounds) curve.places.clear(), curve.tags.clear();
    for (std::size_t s = 0; s < shore.segments().size(); ++s) {
      const Segment& segment = shore.segments()[s];
      Curve& curve = curves_[segment.curve];
      add(curve, segment, before[segment.curve].tags[segment.index], shore.parts_of(s));
    }
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (curves_[c].bounds && !curves_[c].closed)
        curves_[c].places.push_back(before[c].places.back());
  }

 private:
  void add(Curve& curve, const Segment& segment, std::int32_t tag, const std::vector<Part>& parts) {
    const Point<2> a = points_[segment.a], b = points_[segment.b];
    const std::vector<double> cuts = cuts_of(parts);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      curve.places.push_back(segment.a);
      if (cuts[k] > 0) {
        curve.places.back() = static_cast<Place>(points_.size());
        points_.push_back({a[0] + cuts[k] * (b[0] - a[0]), a[1] + cuts[k] * (b[1] - a[1])});
      }
      curve.tags.push_back(tag);
      for (const Part& part : parts)
        if (part.from <= cuts[k] && cuts[k + 1] <= part.to) curve.tags.back() = part.tag;
    }
  }

  std::vector<Curve>& curves_;
  std::vector<Point<2>>& points_;
};

}  // namespace

std::int64_t retag_open_boundaries(std::vector<Curve>& curves, std::vector<Point<2>>& points,
                                   double tolerance) {
  if (std::ranges::none_of(curves, [](const Curve& curve) { return curve.of_line; })) return 0;
  BoundaryFollower shore(curves, points, tolerance);
  std::vector<Curve> left;
  std::int64_t taken = 0;
  for (Curve& curve : curves) {
    if (!curve.of_line || curve.bounds) continue;
    std::vector<Line> others;
    for (Line& line : lines_of(curve)) {
      if (shore.take(line))
        ++taken;
      else
        others.push_back(std::move(line));
    }
    if (others.size() == lines_of(curve).size()) {
      left.push_back(curve);
      continue;
    }
    for (const Line& line : others) left.push_back(curve_of(line));
  }
  if (taken == 0) return 0;
  BoundaryRebuild(curves, points).run(shore);
  std::erase_if(curves, [](const Curve& curve) { return curve.of_line && !curve.bounds; });
  curves.insert(curves.end(), left.begin(), left.end());
  return taken;
}

}  // namespace pnpbs::geo
