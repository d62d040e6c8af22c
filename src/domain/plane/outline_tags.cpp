// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/outline_tags.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/union_find.hpp"

namespace pnpbs {

namespace {

using Ends = std::array<Point<2>, 2>;

Ends in_order(const Point<2>& a, const Point<2>& b) { return a < b ? Ends{a, b} : Ends{b, a}; }

// Returns twice the area to the left of the curve's segments, as seen from the origin.
double twice_area_beside(const BoundaryCurve& curve) {
  double area = 0;
  for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
    area +=
        curve.points[p][0] * curve.points[p + 1][1] - curve.points[p][1] * curve.points[p + 1][0];
  return curve.left_inside ? area : -area;
}

// Returns the ends of all segments of the outline, sorted. The area that a part of the boundary
// has on the side of the domain is positive if the part surrounds the domain, and negative around a
// hole.
std::vector<Ends> segments_of_outline(const ResolvedDomain& domain) {
  UnionFind<std::int64_t> parts(domain.corners.size());
  for (const BoundaryCurve& curve : domain.curves)
    if (curve.bounds()) parts.join(curve.corner_begin, curve.corner_end);
  std::map<std::int64_t, double> areas;
  for (const BoundaryCurve& curve : domain.curves)
    if (curve.bounds()) areas[parts.root(curve.corner_begin)] += twice_area_beside(curve);
  std::vector<Ends> segments;
  for (const BoundaryCurve& curve : domain.curves) {
    if (!curve.bounds() || areas[parts.root(curve.corner_begin)] <= 0) continue;
    for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
      segments.push_back(in_order(curve.points[p], curve.points[p + 1]));
  }
  std::ranges::sort(segments);
  return segments;
}

// A segment of a source, or a smooth source as a whole, whose first segment it is then.
struct SourceSegment {
  std::size_t source;
  std::int64_t segment;
};

Point<2> middle_of_segment(const CurveSource& source, std::int64_t segment) {
  if (source.evaluate) {
    const double t = (source.parameters.front() + source.parameters.back()) / 2;
    Point<2> middle{};
    source.evaluate(1, &t, &middle);
    return middle;
  }
  const auto [a, b] = source.ends(segment);
  return middle_of<2>(source.points[static_cast<std::size_t>(a)],
                      source.points[static_cast<std::size_t>(b)]);
}

// Returns those on the outline.
std::vector<SourceSegment> outline_in(const std::vector<CurveSource>& sources,
                                      const ResolvedDomain& domain) {
  const std::vector<Ends> outline = segments_of_outline(domain);
  std::vector<SourceSegment> found;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const std::int64_t count = sources[s].evaluate ? 1 : sources[s].segment_count();
    for (std::int64_t segment = 0; segment < count; ++segment) {
      const auto [a, b] = sources[s].ends(segment);
      const Ends ends = in_order(sources[s].points[static_cast<std::size_t>(a)],
                                 sources[s].points[static_cast<std::size_t>(b)]);
      if (std::ranges::binary_search(outline, ends)) found.push_back({s, segment});
    }
  }
  return found;
}

}  // namespace

std::int64_t tag_outline(std::vector<CurveSource>& sources, const ResolvedDomain& resolved,
                         const PlaneFunction& where, std::int32_t tag) {
  const std::vector<SourceSegment> segments = outline_in(sources, resolved);
  std::vector<Point<2>> middles;
  for (const auto& [source, segment] : segments)
    middles.push_back(middle_of_segment(sources[source], segment));
  std::vector<double> values(middles.size());
  where(std::ssize(middles), middles.data(), values.data());
  std::int64_t count = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    if (!(values[k] < 0)) continue;
    sources[segments[k].source].tags[static_cast<std::size_t>(segments[k].segment)] = tag;
    ++count;
  }
  return count;
}

}  // namespace pnpbs
