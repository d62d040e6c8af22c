// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/smooth_graph.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/plane/chains.hpp"

namespace pnpbs {

namespace {

// What ends in a vertex: the other ends of up to two segments, and their tags.
struct Incident {
  int segments = 0;
  std::array<std::int64_t, 2> others{};
  std::array<std::int32_t, 2> tags{};
};

std::vector<Incident> incident_segments(const CurveSource& graph) {
  std::vector<Incident> incident(graph.points.size());
  for (std::int64_t s = 0; s < graph.segment_count(); ++s) {
    const auto ends = graph.ends(s);
    for (const std::size_t k : {0, 1}) {
      Incident& here = incident[ends[k]];
      if (here.segments < 2) {
        here.others[here.segments] = ends[1 - k];
        here.tags[here.segments] = graph.segment_tag(s);
      }
      ++here.segments;
    }
  }
  return incident;
}

bool is_corner(const CurveSource& graph, std::size_t point, const Incident& here, double angle) {
  if (here.segments != 2 || here.tags[0] != here.tags[1]) return true;
  const std::int32_t tag = graph.point_tags.empty() ? 0 : graph.point_tags[point];
  if (tag != 0 && tag != here.tags[0]) return true;
  return turn_in_degrees(graph.points[here.others[0]], graph.points[point],
                         graph.points[here.others[1]]) > angle;
}

void put_in_order(CurveSource& graph, const std::vector<Chain>& chains) {
  const CurveSource given = graph;
  graph.segment_ends.clear();
  graph.tags.clear();
  graph.segment_numbers.clear();
  for (const Chain& chain : chains) {
    for (std::size_t k = 0; k < chain.edges.size(); ++k) {
      graph.segment_ends.push_back({chain.vertices[k], chain.vertices[k + 1]});
      graph.tags.push_back(given.segment_tag(chain.edges[k]));
      graph.segment_numbers.push_back(given.segment_number(chain.edges[k]));
    }
    if (chain.closed) graph.corners[chain.vertices.front()] = 1;  // it begins somewhere
  }
}

}  // namespace

double turn_in_degrees(const Point<2>& before, const Point<2>& at, const Point<2>& after) {
  const double ux = at[0] - before[0], uy = at[1] - before[1];
  const double vx = after[0] - at[0], vy = after[1] - at[1];
  return std::atan2(std::fabs(ux * vy - uy * vx), ux * vx + uy * vy) * 180 / std::numbers::pi;
}

void find_corners(CurveSource& graph, double corner_angle) {
  graph.corners.assign(graph.points.size(), 1);
  if (corner_angle == 0) return;
  const std::vector<Incident> incident = incident_segments(graph);
  for (std::size_t p = 0; p < graph.points.size(); ++p)
    graph.corners[p] = is_corner(graph, p, incident[p], corner_angle) ? 1 : 0;
  std::vector<std::array<std::int32_t, 2>> ends;
  for (const auto& [a, b] : graph.segment_ends)
    ends.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
  put_in_order(graph, chains_between(graph.corners, ends));
}

}  // namespace pnpbs
