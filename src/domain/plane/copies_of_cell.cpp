// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/copies_of_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/union_find.hpp"
#include "domain/images_near_cell.hpp"
#include "geometry/volume/welding.hpp"

namespace pnpbs {

namespace {

CurveSource image_of(const PeriodicCell<2>& cell, const ImagesNearCell<2>& images,
                     const Image<2>& image, CurveSource source) {
  for (Point<2>& x : source.points) x = images.moved(image, x);
  if (source.evaluate)
    source.evaluate = [cell, opposite = Image<2>{-image[0], -image[1]},
                       evaluate = std::move(source.evaluate)](std::int64_t n, const double* t,
                                                              Point<2>* x) {
      evaluate(n, t, x);
      for (std::int64_t i = 0; i < n; ++i) x[i] = cell.seen_from(opposite, cell.rounded(x[i]));
    };
  return source;
}

CurveSource line_between(const Point<2>& begin, const Point<2>& end, std::int32_t tag,
                         CurveRole role = CurveRole::boundary) {
  CurveSource line;
  line.kind = CurveSource::Kind::polyline;
  line.number = -1;
  line.role = role;
  line.tags = {tag};
  line.points = {begin, end};
  return line;
}

// Distance within which points of opposite sides are the same point. [longest side of the cell]
constexpr double kSameOnSides = 1e-9;

// Curves that have ends or vertices in common form a part.
class PartsOfCurves {
 public:
  explicit PartsOfCurves(const std::vector<CurveSource>& sources)
      : sources_(sources), groups_(sources.size()) {
    Box<2> box = empty_box<2>();
    for (std::size_t s = 0; s < sources.size(); ++s) {
      for (const Point<2>& x : sources[s].points) include(box, x);
      add_ends(s);
    }
    join(box);
    for (std::size_t s = 0; s < sources.size(); ++s)
      if (root(s) == s) {
        part_of_root_.emplace_back(parts_.size());
        parts_.push_back(part(s));
      } else {
        part_of_root_.push_back(part_of_root_[root(s)]);
      }
  }

  // Throws Error(ErrorKind::domain) if a curve ends on a periodic side of the cell and none goes on
  // from there at the opposite side.
  void require_continued(const PeriodicCell<2>& cell) {
    const Box<2>& box = cell.box();
    const double same = kSameOnSides * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
    const auto at = [&](std::size_t e) { return Point<2>{points_[e][0], points_[e][1]}; };
    for (const std::size_t e : open_)
      for (std::size_t k = 0; k < 2; ++k)
        for (const double sign : {1.0, -1.0}) {
          const double side = sign > 0 ? box.low[k] : box.high[k];
          if (!cell.periodic(static_cast<int>(k)) || std::fabs(at(e)[k] - side) > same) continue;
          Point<2> opposite = at(e);
          opposite[k] += sign * cell.period(static_cast<int>(k));
          if (std::ranges::any_of(open_, [&](std::size_t other) {
                return distance<2>(at(other), opposite) <= same;
              }))
            continue;
          reject_domain("curve " + std::to_string(sources_[ends_[e]].number) +
                        " ends on a side of the periodic domain at " + point_text(at(e)) +
                        ", and no curve goes on from " + point_text(opposite) +
                        " at the opposite side: let curves end at the same points of both sides");
        }
  }

  // Returns the part to which a source belongs.
  std::size_t of(std::size_t source) const { return part_of_root_[source]; }
  std::vector<ConnectedPart<2>> take() { return std::move(parts_); }

 private:
  std::size_t root(std::size_t s) { return groups_.root(s); }

  void add_ends(std::size_t s) {
    const CurveSource& source = sources_[s];
    if (source.closed) return;
    const auto add = [&](std::int64_t point) {
      const Point<2>& x = source.points[static_cast<std::size_t>(point)];
      ends_.push_back(s);
      points_.push_back({x[0], x[1], 0});
    };
    if (source.kind == CurveSource::Kind::graph) {
      for (const auto& segment : source.segment_ends) add(segment[0]), add(segment[1]);
    } else {
      add(0);
      add(std::ssize(source.points) - 1);
    }
  }

  // Joins the curves that end at a common point, and finds those that end alone.
  void join(const Box<2>& box) {
    double size = 0;
    for (std::size_t k = 0; k < 2; ++k) size = std::max(size, box.high[k] - box.low[k]);
    const std::vector<std::int32_t> welded = weld_points(points_, kSameCurveEnd * size);
    std::vector<char> met(points_.size());
    for (std::size_t e = 0; e < points_.size(); ++e) {
      const auto first = static_cast<std::size_t>(welded[e]);
      groups_.join(ends_[e], ends_[first]);
      if (first != e) met[e] = met[first] = 1;
    }
    for (std::size_t e = 0; e < points_.size(); ++e)
      if (met[e] == 0) open_.push_back(e);
  }

  ConnectedPart<2> part(std::size_t first) {
    ConnectedPart<2> part{empty_box<2>(), true, sources_[first].points[0], {}};
    std::vector<std::array<Point<2>, 2>> segments;
    for (std::size_t s = first; s < sources_.size(); ++s) {
      if (root(s) != first) continue;
      const CurveSource& source = sources_[s];
      for (const Point<2>& x : source.points) include(part.box, x);
      for (std::int64_t k = 0; k < source.segment_count(); ++k) {
        const auto [a, b] = source.ends(k);
        segments.push_back({source.points[static_cast<std::size_t>(a)],
                            source.points[static_cast<std::size_t>(b)]});
      }
    }
    for (const std::size_t e : open_) part.closed = part.closed && root(ends_[e]) != first;
    part.encloses = [segments = std::move(segments)](const Point<2>& x) {
      bool inside = false;
      for (const auto& [a, b] : segments) {
        if ((a[1] > x[1]) == (b[1] > x[1])) continue;
        inside ^= x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      }
      return inside;
    };
    return part;
  }

  const std::vector<CurveSource>& sources_;
  UnionFind<std::size_t> groups_;
  std::vector<Point<3>> points_;   // ends of curves and of segments of graphs
  std::vector<std::size_t> ends_;  // the sources of these points
  std::vector<std::size_t> open_;  // points at which no other curve ends
  std::vector<std::size_t> part_of_root_;
  std::vector<ConnectedPart<2>> parts_;
};

// Returns whether a line along an axis lies on a lower side of the box.
bool lies_on_lower_side(const CurveSource& line, const Box<2>& box) {
  return std::ranges::all_of(line.points, [&](const auto& x) { return x[0] == box.low[0]; }) ||
         std::ranges::all_of(line.points, [&](const auto& x) { return x[1] == box.low[1]; });
}

}  // namespace

CopiesOfCell copies_of_cell(const PeriodicCell<2>& cell, double reach,
                            const std::array<std::int32_t, 4>& side_tags,
                            const std::array<bool, 2>& flat,
                            const std::vector<CurveSource>& sources,
                            const std::vector<RegionPoint<2>>& region_points,
                            const std::vector<FixedNode<2>>& fixed_nodes) {
  PartsOfCurves parts(sources);
  parts.require_continued(cell);
  const ImagesNearCell<2> images(cell, reach, !region_points.empty(), true, parts.take());
  CopiesOfCell all;
  // The sides of the cell that bound the domain, or are flat, are lines of one period.
  std::vector<CurveSource> sides;
  const Box<2>&box = cell.box(), outer = images.outer();
  for (std::size_t k = 0; k < 2; ++k) {
    if (flat[k]) {
      Point<2> end = box.high;
      end[k] = box.low[k];
      sides.push_back(line_between(box.low, end, side_tags[2 * k], CurveRole::inner));
    }
    if (cell.periodic(static_cast<int>(k))) continue;
    for (std::size_t high = 0; high < 2; ++high) {
      Point<2> begin = box.low, end = box.high;
      begin[k] = end[k] = high != 0 ? box.high[k] : box.low[k];
      sides.push_back(line_between(begin, end, side_tags[2 * k + high]));
    }
  }
  images.for_copies([&](const Image<2>& image) {
    for (std::size_t s = 0; s < sources.size(); ++s) {
      if (!images.has(parts.of(s), image)) continue;
      all.sources.push_back(image_of(cell, images, image, sources[s]));
      all.in_cell.push_back(images.is_home(parts.of(s), image));
    }
    for (const CurveSource& side : sides) {
      CurveSource copy = image_of(cell, images, image, side);
      if (copy.role == CurveRole::inner && lies_on_lower_side(copy, outer)) continue;
      all.sources.push_back(std::move(copy));
      all.in_cell.push_back(image == Image<2>{});
    }
  });
  all.region_points = images.images_of(region_points);
  all.fixed_nodes = images.images_of(fixed_nodes);
  // The boundary around the copies
  const Point<2>&a = outer.low, &b = outer.high;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!cell.periodic(static_cast<int>(k))) continue;
    for (const double at : {a[k], b[k]}) {
      Point<2> begin = a, end = b;
      begin[k] = end[k] = at;
      all.sources.push_back(line_between(begin, end, 1));
      all.in_cell.push_back(0);
    }
  }
  return all;
}

// By Green's theorem, as the integral of one coordinate along the curves. Periodic sides of the
// cell do not contribute if it is the coordinate across the period.
double area_of_cell(const PeriodicCell<2>& cell, const std::vector<BoundaryCurve>& curves,
                    const std::vector<char>& in_cell) {
  const Box<2>& box = cell.box();
  const bool all_periodic = cell.periodic(0) && cell.periodic(1);
  double area = all_periodic ? cell.period(0) * cell.period(1) : 0;
  const auto segment = [&](const Point<2>& p, const Point<2>& q) {
    return cell.periodic(0) ? -(0.5 * (p[1] + q[1]) - box.low[1]) * (q[0] - p[0])
                            : (0.5 * (p[0] + q[0]) - box.low[0]) * (q[1] - p[1]);
  };
  for (const BoundaryCurve& curve : curves) {
    if (!curve.bounds() || !in_cell[static_cast<std::size_t>(curve.source)]) continue;
    const double sign = curve.left_inside ? 1 : -1;
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Point<2>&p = curve.points[i], &q = curve.points[i + 1];
      area += sign * segment(p, q);
      if (!curve.evaluate) continue;
      const double t = 0.5 * curve.parameters[i] + 0.5 * curve.parameters[i + 1];
      Point<2> middle;
      curve.evaluate(1, &t, &middle);
      // A parabola through the middle is apart from the chord by 4/3 of this triangle.
      area += sign * 4 / 3 * 0.5 *
              ((middle[0] - p[0]) * (q[1] - p[1]) - (middle[1] - p[1]) * (q[0] - p[0]));
    }
  }
  return area;
}

}  // namespace pnpbs
