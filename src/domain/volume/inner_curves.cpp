// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/inner_curves.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "geometry/volume/triangle_contacts.hpp"

namespace pnpbs {

namespace {

Box<3> box_of(const Point<3>& a, const Point<3>& b, double reach) {
  return joined(box_around<3>(a, reach), box_around<3>(b, reach));
}

void check_against_surface(CurveSegment& segment, const Triangulation& surface,
                           const BoxTree<3>& tree) {
  const auto p = segment.ends[0], q = segment.ends[1];
  const Point<3>&x = surface.vertices[p], &y = surface.vertices[q];
  std::int32_t met = -1;
  tree.for_meeting(box_of(x, y, 0), [&](std::int32_t t) {
    const SurfaceTriangle& triangle = surface.triangles[t];
    FacetCorners<3> corners = surface.corners(t);
    const bool has_p = triangle.has(p), has_q = triangle.has(q);
    if (has_p && has_q) {
      if (segment.along < 0 || t < segment.along) segment.along = t;
      return;
    }
    const auto begin = triangle.vertices.begin();
    if (has_p || has_q) {
      const auto common = std::find(begin, triangle.vertices.end(), has_p ? p : q) - begin;
      std::swap(corners[0], corners[static_cast<std::size_t>(common)]);
    }
    const bool meets =
        has_p || has_q ? segment_runs_into(has_p ? y : x, corners) : segment_meets(x, y, corners);
    if (meets && (met < 0 || t < met)) met = t;
  });
  if (met < 0) return;
  const Point<3> place = meeting_point(x, y, surface.corners(met));
  reject_domain(segment.name + " meets " + surface.triangle_name(met) + " at " + point_text(place) +
                ": a curve and a surface may meet in common vertices only, unless "
                "pnpbs_domain_set_fragment splits both there");
}

// Returns true if one of two segments with a common end lies on the other.
bool fold_back(const Point<3>& common, const Point<3>& x, const Point<3>& y, double same_place) {
  const SegmentEnds s{common, x}, t{common, y};
  return distance<3>(nearest_on_segment(s, y), y) <= same_place ||
         distance<3>(nearest_on_segment(t, x), x) <= same_place;
}

void check_pair(const CurveSegment& s, const CurveSegment& t, const std::vector<Point<3>>& vertices,
                double same_place) {
  for (const int i : {0, 1})
    for (const int j : {0, 1}) {
      if (s.ends[i] != t.ends[j]) continue;
      if (fold_back(vertices[s.ends[i]], vertices[s.ends[1 - i]], vertices[t.ends[1 - j]],
                    same_place))
        reject_domain(s.name + " and " + t.name + " overlap at " + point_text(vertices[s.ends[i]]));
      return;
    }
  const SegmentEnds x{vertices[s.ends[0]], vertices[s.ends[1]]};
  const SegmentEnds y{vertices[t.ends[0]], vertices[t.ends[1]]};
  const Point<3> place = nearest_to_segment(x, y);
  if (distance<3>(place, nearest_on_segment(y, place)) > same_place) return;
  reject_domain(s.name + " and " + t.name + " meet at " + point_text(place));
}

}  // namespace

std::vector<CurveSegment> make_segments(const std::vector<InnerPolyline>& polylines,
                                        const std::vector<std::int32_t>& vertex_of,
                                        const std::vector<Point<3>>& vertices) {
  std::vector<CurveSegment> segments;
  std::size_t first = 0;
  for (const InnerPolyline& curve : polylines) {
    for (std::size_t i = 0; i < curve.tags.size(); ++i) {
      const std::size_t next = (i + 1) % curve.points.size();
      segments.push_back({{vertex_of[first + i], vertex_of[first + next]},
                          curve.tags[i],
                          "segment " + std::to_string(i) + " of " + curve.name});
      const auto& [begin, end] = segments.back().ends;
      if (begin == end)
        reject_domain(segments.back().name + " is too short at " + point_text(vertices[begin]) +
                      ": its ends count as the same point");
    }
    first += curve.points.size();
  }
  return segments;
}

BoxTree<3> tree_of(const std::vector<CurveSegment>& segments,
                   const std::vector<Point<3>>& vertices) {
  std::vector<Box<3>> boxes;
  for (const CurveSegment& segment : segments)
    boxes.push_back(box_of(vertices[segment.ends[0]], vertices[segment.ends[1]], 0));
  return BoxTree<3>(std::move(boxes));
}

void check_segments(std::vector<CurveSegment>& segments, const Triangulation& surface,
                    const BoxTree<3>& tree, double same_place) {
  for (CurveSegment& segment : segments) check_against_surface(segment, surface, tree);
  const BoxTree<3> near = tree_of(segments, surface.vertices);
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(segments.size()); ++s) {
    const auto& [begin, end] = segments[s].ends;
    std::vector<std::int32_t> others;
    near.for_meeting(box_of(surface.vertices[begin], surface.vertices[end], same_place),
                     [&](std::int32_t other) {
                       if (other > s) others.push_back(other);
                     });
    std::sort(others.begin(), others.end());  // so that the same pair is always reported
    for (const std::int32_t other : others)
      check_pair(segments[s], segments[other], surface.vertices, same_place);
  }
}

}  // namespace pnpbs
