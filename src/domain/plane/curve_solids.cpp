// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_solids.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/index.hpp"
#include "geometry/region_graph.hpp"

namespace pnpbs {

namespace {

using Kind = CurveSource::Kind;

// Returns twice the area that a polygon encloses, positive if it is counter-clockwise.
double twice_area(const std::vector<Point<2>>& polygon) {
  const Point<2>& origin = polygon.front();
  double area = 0;
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i) {
    const Point<2>&a = polygon[i], &b = polygon[i + 1];
    area += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
  }
  return area;
}

bool encloses(const std::vector<Point<2>>& polygon, const Point<2>& x) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a[1] > x[1]) == (b[1] > x[1])) continue;
    if (x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

// Returns whether a polygon encloses another one that does not cross it. They may have common
// vertices.
bool encloses(const std::vector<Point<2>>& polygon, const std::vector<Point<2>>& other) {
  const std::set<Point<2>> vertices(polygon.begin(), polygon.end());
  const auto apart =
      std::ranges::find_if(other, [&](const Point<2>& x) { return !vertices.contains(x); });
  return apart != other.end() && encloses(polygon, *apart);
}

// Returns whether an even number of the segments ends in each point.
bool is_closed(const CurveSource& graph, const std::vector<std::int64_t>& segments) {
  std::map<std::int64_t, int> ends;
  for (const std::int64_t s : segments)
    for (const std::int64_t end : graph.ends(s)) ends[end] ^= 1;
  return std::ranges::all_of(ends, [](const auto& end) { return end.second == 0; });
}

// An open curve between two vertices.
struct OpenCurve {
  std::int32_t source;
  std::array<std::int32_t, 2> ends;
};

// Takes the curves from `open` that lead from the end of the first one back to its begin. Returns
// them in order with their directions, or nothing if there is no way back.
std::vector<std::pair<std::int32_t, bool>> take_loop(std::vector<OpenCurve>& open) {
  std::vector<std::pair<std::int32_t, bool>> loop;
  std::vector<char> used(open.size(), 0);
  const auto take = [&](std::size_t k, bool forward) {
    used[k] = 1;
    loop.emplace_back(open[k].source, forward);
    return open[k].ends[forward ? 1 : 0];
  };
  std::int32_t at = take(0, true);
  while (at != open[0].ends[0]) {
    const auto next = std::ranges::find_if(open, [&](const OpenCurve& curve) {
      return used[index(&curve - open.data())] == 0 && (curve.ends[0] == at || curve.ends[1] == at);
    });
    if (next == open.end()) return {};
    at = take(index(next - open.begin()), next->ends[0] == at);
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < open.size(); ++k)
    if (used[k] == 0) open[kept++] = open[k];
  open.resize(kept);
  return loop;
}

}  // namespace

CurveSolids::CurveSolids(const std::vector<CurveSource>& sources, const DomainGraph& graph)
    : rings_(sources.size()) {
  add_loops(sources, graph);
  for (std::size_t s = 0; s < sources.size(); ++s)
    if (sources[s].kind == Kind::graph) add_graph(sources[s], static_cast<std::int32_t>(s));
}

void CurveSolids::add_loops(const std::vector<CurveSource>& sources, const DomainGraph& graph) {
  std::vector<std::array<std::int32_t, 2>> ends(sources.size(), {-1, -1});
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    std::array<std::int32_t, 2>& of_source = ends[index(graph.edges[e].source)];
    if (of_source[0] < 0) of_source[0] = graph.ends[e][0];
    of_source[1] = graph.ends[e][1];
  }
  std::vector<OpenCurve> open;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const CurveSource& source = sources[s];
    const auto number = static_cast<std::int32_t>(s);
    if (source.kind == Kind::graph || source.role != CurveRole::boundary) continue;
    if (!source.closed && ends[s][0] != ends[s][1]) open.push_back({number, ends[s]});
  }
  std::map<std::int32_t, std::vector<std::pair<std::int32_t, bool>>> loops;  // by first source
  std::vector<OpenCurve> rest;
  while (!open.empty()) {
    const auto loop = take_loop(open);
    if (!loop.empty()) {
      loops[loop[0].first] = loop;
    } else {
      rest.push_back(open.front());
      open.erase(open.begin());
    }
  }
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const CurveSource& source = sources[s];
    const auto number = static_cast<std::int32_t>(s);
    if (source.kind == Kind::graph || source.role != CurveRole::boundary) continue;
    if (source.closed || ends[s][0] == ends[s][1]) {
      add_loop({number}, source.points);
    } else if (const auto loop = loops.find(number); loop != loops.end()) {
      std::vector<std::int32_t> members;
      Polygon polygon;
      for (const auto& [member, forward] : loop->second) {
        members.push_back(member);
        const std::vector<Point<2>>& points = sources[index(member)].points;
        if (forward) {
          polygon.insert(polygon.end(), points.begin(), points.end());
        } else {
          polygon.insert(polygon.end(), points.rbegin(), points.rend());
        }
      }
      add_loop(members, polygon);
    }
  }
  if (rest.empty()) return;
  const std::int32_t ring = add_solid();
  for (const OpenCurve& curve : rest) rings_[index(curve.source)].of_all = ring;
}

void CurveSolids::add_loop(const std::vector<std::int32_t>& of_sources, const Polygon& polygon) {
  const bool is_cavity = !last_polygon_.empty() &&
                         (twice_area(polygon) > 0) != (twice_area(last_polygon_) > 0) &&
                         encloses(last_polygon_, polygon);
  const std::int32_t ring = ring_count_;
  if (is_cavity) {
    ++ring_count_;
    solids_.back().cavities.push_back(ring);
  } else {
    add_solid();
    last_polygon_ = polygon;
  }
  for (const std::int32_t source : of_sources) rings_[index(source)].of_all = ring;
}

// Adds a solid without cavities and returns its ring.
std::int32_t CurveSolids::add_solid() {
  solids_.push_back({ring_count_, {}});
  return ring_count_++;
}

void CurveSolids::add_graph(const CurveSource& source, std::int32_t number) {
  std::map<std::int32_t, std::vector<std::int64_t>> groups;
  for (std::int64_t s = 0; s < source.segment_count(); ++s)
    groups[source.segment_tag(s)].push_back(s);
  RingsOfSource& rings = rings_[index(number)];
  rings.of_segments.assign(index(source.segment_count()), -1);
  bool any_rest = false;
  for (const auto& [tag, segments] : groups) {
    if (groups.size() == 1 || !is_closed(source, segments)) {
      any_rest = true;
      continue;
    }
    const std::int32_t ring = add_solid();
    solids_.back().graph = number;
    for (const std::int64_t s : segments) rings.of_segments[index(s)] = ring;
  }
  if (!any_rest) return;
  rings.of_all = add_solid();
  solids_.back().graph = number;
  solids_.back().is_rest = true;
}

// Returns the rings that each edge of the graph belongs to.
std::vector<std::vector<std::int32_t>> CurveSolids::rings_at_edges(const DomainGraph& graph) const {
  std::vector<std::vector<std::int32_t>> at(graph.edges.size());
  const auto add = [&](std::vector<std::int32_t>& rings, const GraphEdge& edge) {
    const RingsOfSource& of = rings_[index(edge.source)];
    if (of.of_all >= 0) rings.push_back(of.of_all);
    if (!of.of_segments.empty() && of.of_segments[index(edge.segment)] >= 0)
      rings.push_back(of.of_segments[index(edge.segment)]);
  };
  for (std::size_t e = 0; e < at.size(); ++e) add(at[e], graph.edges[e]);
  for (const auto& [edge, united] : graph.united) add(at[index(edge)], united);
  return at;
}

std::vector<std::vector<std::int32_t>> CurveSolids::around(const DomainGraph& graph,
                                                           const Faces& faces) const {
  const std::vector<std::vector<std::int32_t>> rings = rings_at_edges(graph);
  const auto face_count = index(faces.count);
  std::vector<std::array<std::int32_t, 2>> contacts;
  for (std::size_t e = 0; e < rings.size(); ++e)
    contacts.push_back({faces.of_side[2 * e], faces.of_side[2 * e + 1]});
  const RegionGraph regions(face_count, std::move(contacts));
  // Returns for each face whether the ring does not enclose it.
  const auto outside = [&](std::int32_t ring) {
    return regions.reached([&](std::int32_t, std::size_t e, std::int32_t) {
      return std::ranges::find(rings[e], ring) == rings[e].end();
    });
  };
  std::vector<std::vector<std::int32_t>> around(face_count);
  for (std::int32_t s = 0; s < count(); ++s) {
    const Solid& solid = solids_[index(s)];
    std::vector<char> without = outside(solid.outline);
    for (const std::int32_t ring : solid.cavities) {
      const std::vector<char> beside_cavity = outside(ring);
      for (std::size_t face = 0; face < face_count; ++face)
        if (beside_cavity[face] == 0) without[face] = 1;
    }
    for (std::size_t face = 0; face < face_count; ++face) {
      if (without[face] != 0) continue;
      const auto is_of_graph = [&](std::int32_t other) {
        return solids_[index(other)].graph == solid.graph;
      };
      if (solid.is_rest && std::ranges::any_of(around[face], is_of_graph)) continue;
      around[face].push_back(s);
    }
  }
  return around;
}

}  // namespace pnpbs
