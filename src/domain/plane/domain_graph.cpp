// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/domain_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "geometry/plane/chains.hpp"
#include "geometry/plane/point_tree.hpp"

namespace pnpbs {
namespace {

using Kind = CurveSource::Kind;

// A point as given, before points at the same position become one vertex.
struct GivenPoint {
  std::int32_t source;
  std::int64_t index;
  std::int32_t fixed;
  std::int32_t tag;
  bool corner;
  bool curve_end;
  bool crossing = false;
};

// Distance within which a crossing lies on the edges that cross. It covers the rounding of its
// coordinates, which is large far from the origin. [unit of the last digit]
constexpr double kCrossingDigits = 16;

// Edges are split at a vertex within this distance if a crossing was joined to it. [distance above]
constexpr double kJoinedCrossing = 2;

bool is_corner(const CurveSource& source, std::int64_t point) {
  if (source.kind == Kind::graph) return source.corners.empty() || source.corners[point];
  if (source.ends_at(point)) return true;
  if (source.kind == Kind::smooth) return false;
  if (!source.on_the_way.empty() && source.on_the_way[point]) return false;
  if (source.corner_angle == 0) return true;
  const auto count = static_cast<std::int64_t>(source.points.size());
  const std::int64_t before = point == 0 ? count - 1 : point - 1;
  if (source.segment_tag(before) != source.segment_tag(point)) return true;
  const std::int64_t after = point + 1 == count ? 0 : point + 1;
  return turn_in_degrees(source.points[before], source.points[point], source.points[after]) >
         source.corner_angle;
}

class Joiner {
 public:
  Joiner(const std::vector<CurveSource>& sources, const std::vector<FixedNode<2>>& fixed_nodes,
         const std::vector<Point<2>>& crossings, Unite unite, double size)
      : sources_(sources), fixed_nodes_(fixed_nodes), crossings_(crossings), unite_(unite) {
    graph_.size = size;
    double farthest = 0;
    for (const Point<2>& x : crossings)
      farthest = std::max({farthest, std::fabs(x[0]), std::fabs(x[1])});
    same_crossing_ = std::max(kSamePoint * size,
                              kCrossingDigits * std::numeric_limits<double>::epsilon() * farthest);
  }

  DomainGraph run() {
    list_points();
    merge_points();
    make_vertices();
    make_edges();
    split_edges();
    if (unite_ != Unite::none) unite_edges();
    count_degrees();
    return std::move(graph_);
  }

 private:
  void list_points() {
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const CurveSource& source = sources_[s];
      first_point_.push_back(static_cast<std::int32_t>(given_.size()));
      for (std::int64_t i = 0; i < static_cast<std::int64_t>(source.points.size()); ++i) {
        const std::int32_t tag = source.point_tags.empty() ? 0 : source.point_tags[i];
        given_.push_back(
            {static_cast<std::int32_t>(s), i, -1, tag, is_corner(source, i), source.ends_at(i)});
        positions_.push_back(source.points[i]);
      }
    }
    for (std::size_t f = 0; f < fixed_nodes_.size(); ++f) {
      const auto fixed = static_cast<std::int32_t>(f);
      given_.push_back({-1, fixed, fixed, fixed_nodes_[f].tag, true, false});
      positions_.push_back(fixed_nodes_[f].position);
    }
    for (const Point<2>& crossing : crossings_) {
      const auto number = static_cast<std::int64_t>(given_.size());
      given_.push_back({-1, number, -1, 0, true, false, true});
      positions_.push_back(crossing);
    }
    if (given_.size() >= (std::size_t{1} << 31) - 1)
      reject_domain("the domain has 2^31 points or more");
  }

  // Returns true for samples inside smooth curves. They join other points only at positions where a
  // point was given; curves that happen to share a sample still cross.
  bool is_mere_sample(std::int32_t point) const {
    const GivenPoint& given = given_[point];
    return given.source >= 0 && sources_[given.source].kind == Kind::smooth && !given.curve_end;
  }

  void merge_points() {
    const PointTree tree(positions_);
    root_.resize(given_.size());
    std::iota(root_.begin(), root_.end(), 0);
    const auto count = static_cast<std::int32_t>(given_.size());
    for (std::int32_t p = 0; p < count; ++p) {
      if (!is_mere_sample(p)) join_nearest(p, tree);
    }
    for (std::int32_t p = 0; p < count; ++p) {
      if (is_mere_sample(p)) join_nearest(p, tree);
    }
  }

  // Joins point p to the nearest earlier point within the tolerance that is not itself joined.
  void join_nearest(std::int32_t p, const PointTree& tree) {
    std::pair<double, std::int32_t> nearest{graph_.size, p};
    tree.for_each_near(positions_[p], positions_[p],
                       std::max(kSameCurveEnd * graph_.size, same_crossing_),
                       [&](std::int32_t other, double distance) {
                         if (other == p || root_[other] != other || is_mere_sample(other)) return;
                         if (other > p && !is_mere_sample(p)) return;
                         if (distance > same_position(given_[p], given_[other])) return;
                         nearest = std::min(nearest, {distance, other});
                       });
    if (nearest.second == p) return;
    require_may_join(nearest.second, p);
    root_[p] = nearest.second;
  }

  // Returns the distance within which two points have the same position.
  double same_position(const GivenPoint& a, const GivenPoint& b) const {
    if (a.crossing || b.crossing) return same_crossing_;
    return (a.curve_end || b.curve_end ? kSameCurveEnd : kSamePoint) * graph_.size;
  }

  void require_may_join(std::int32_t a, std::int32_t b) const {
    const GivenPoint &first = given_[a], &second = given_[b];
    const bool both_fixed = first.fixed >= 0 && second.fixed >= 0;
    const bool same_graph = first.source == second.source && first.source >= 0 &&
                            sources_[first.source].kind == Kind::graph;
    if (!both_fixed && (!same_graph || is_snapped(first) || is_snapped(second))) return;
    const MessageText where = positions_[a] == positions_[b]
                                  ? " are both at " + point_text(positions_[a])
                                  : " are too close, at " + point_text(positions_[a]) + " and " +
                                        point_text(positions_[b]);
    reject_domain(point_name(a) + " and " + point_name(b) + where +
                  (both_fixed ? "; leave one of them out" : "; let all segments use one of them"));
  }

  bool is_snapped(const GivenPoint& given) const {
    const std::vector<char>& snapped = sources_[given.source].snapped;
    return !snapped.empty() && snapped[given.index];
  }

  std::string point_name(std::int32_t point) const {
    const GivenPoint& given = given_[point];
    if (given.source < 0) return fixed_nodes_[given.fixed].name;
    return sources_[given.source].point_name(given.index);
  }

  // Returns the priority by which points determine the position of their vertex. Computed points of
  // smooth curves have the lowest.
  int weight(std::int32_t point) const {
    if (given_[point].fixed >= 0) return 2;
    if (given_[point].crossing) return 1;
    return sources_[given_[point].source].kind == Kind::smooth ? 0 : 1;
  }

  void make_vertices() {
    vertex_of_.assign(given_.size(), -1);
    std::vector<int> weights;
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(given_.size()); ++p) {
      std::int32_t& vertex = vertex_of_[root_[p]];
      if (vertex < 0) {
        const GivenPoint& root = given_[root_[p]];
        vertex = static_cast<std::int32_t>(graph_.vertices.size());
        graph_.vertices.push_back({positions_[root_[p]], root.source, root.index, root.fixed,
                                   root.tag, 0, root.corner, root.crossing});
        weights.push_back(weight(root_[p]));
      }
      vertex_of_[p] = vertex;
      if (root_[p] != p) add_to_vertex(graph_.vertices[vertex], p, weights[vertex]);
    }
  }

  void add_to_vertex(GraphVertex& vertex, std::int32_t point, int& max_weight) {
    const GivenPoint& given = given_[point];
    vertex.corner = true;  // curves meet here
    vertex.crossing = vertex.crossing || given.crossing;
    if (vertex.fixed < 0) vertex.fixed = given.fixed;
    if (given.fixed >= 0 || vertex.tag == 0) vertex.tag = given.tag;
    if (weight(point) <= max_weight) return;
    max_weight = weight(point);
    vertex.position = positions_[point];
  }

  void make_edges() {
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const CurveSource& source = sources_[s];
      const bool smooth = source.kind == Kind::smooth;
      for (std::int64_t i = 0; i < source.segment_count(); ++i) {
        const auto [begin, end] = source.ends(i);
        const VertexPair ends{vertex_of_[first_point_[s] + begin],
                              vertex_of_[first_point_[s] + end]};
        if (ends[0] == ends[1]) {
          reject_domain(source.segment_name(i) + " is too short at " +
                        point_text(graph_.vertices[ends[0]].position) +
                        ": its ends count as the same point in a domain of size " +
                        number_text(graph_.size));
        }
        graph_.ends.push_back(ends);
        graph_.edges.push_back({static_cast<std::int32_t>(s), i, smooth ? source.parameters[i] : 0,
                                smooth ? source.parameters[i + 1] : 0});
      }
    }
  }

  // Vertices on an edge, as pairs (fraction of the edge, vertex) in ascending order.
  using Stops = std::vector<std::pair<double, std::int32_t>>;

  Stops vertices_on(const VertexPair& ends, const PointTree& tree) const {
    const Point<2>& a = graph_.vertices[ends[0]].position;
    const Point<2>& b = graph_.vertices[ends[1]].position;
    Stops stops;
    const double same = kSamePoint * graph_.size, reach = kJoinedCrossing * same_crossing_;
    tree.for_each_near(a, b, std::max(same, reach), [&](std::int32_t which, double distance) {
      const std::int32_t vertex = splitting_[which];
      if (vertex == ends[0] || vertex == ends[1]) return;
      if (distance > (graph_.vertices[vertex].crossing ? reach : same)) return;
      const Point<2>& p = graph_.vertices[vertex].position;
      const double ux = b[0] - a[0], uy = b[1] - a[1];
      const double fraction = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy);
      if (fraction > 0 && fraction < 1) stops.push_back({fraction, vertex});
    });
    std::sort(stops.begin(), stops.end());
    return stops;
  }

  void split_edges() {
    std::vector<Point<2>> positions;
    splitting_.clear();
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(graph_.vertices.size()); ++v) {
      const GraphVertex& vertex = graph_.vertices[v];
      const bool mere_sample = !vertex.corner && sources_[vertex.source].kind == Kind::smooth;
      if (mere_sample) continue;
      splitting_.push_back(v);
      positions.push_back(vertex.position);
    }
    const PointTree tree(std::move(positions));
    std::vector<GraphEdge> edges;
    std::vector<VertexPair> ends;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      GraphEdge rest = graph_.edges[e];
      std::int32_t begin = graph_.ends[e][0];
      for (const auto& [fraction, vertex] : vertices_on(graph_.ends[e], tree)) {
        const GraphEdge& whole = graph_.edges[e];
        const double t = whole.t_begin + fraction * (whole.t_end - whole.t_begin);
        edges.push_back({rest.source, rest.segment, rest.t_begin, t});
        ends.push_back({begin, vertex});
        graph_.vertices[vertex].corner = true;
        rest.t_begin = t;
        begin = vertex;
      }
      edges.push_back(rest);
      ends.push_back({begin, graph_.ends[e][1]});
    }
    graph_.edges = std::move(edges);
    graph_.ends = std::move(ends);
  }

  // Unites straight edges with the same ends. Chains of edges end there, so the ends are corners.
  void unite_edges() {
    std::map<VertexPair, std::int32_t> first;
    std::size_t kept = 0;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& edge = graph_.edges[e];
      const auto& [a, b] = graph_.ends[e];
      if (sources_[edge.source].kind != Kind::smooth) {
        const auto [entry, is_new] = first.try_emplace(VertexPair{std::min(a, b), std::max(a, b)},
                                                       static_cast<std::int32_t>(kept));
        const bool same_source = graph_.edges[entry->second].source == edge.source;
        if (!is_new && (unite_ == Unite::all || !same_source)) {
          graph_.vertices[a].corner = graph_.vertices[b].corner = true;
          graph_.united.push_back({entry->second, edge});
          continue;
        }
      }
      graph_.edges[kept] = edge;
      graph_.ends[kept++] = graph_.ends[e];
    }
    graph_.edges.resize(kept);
    graph_.ends.resize(kept);
  }

  void count_degrees() {
    for (const VertexPair& ends : graph_.ends) {
      ++graph_.vertices[ends[0]].degree;
      ++graph_.vertices[ends[1]].degree;
    }
    for (GraphVertex& vertex : graph_.vertices) {
      if (vertex.degree != 2) vertex.corner = true;
    }
  }

  const std::vector<CurveSource>& sources_;
  const std::vector<FixedNode<2>>& fixed_nodes_;
  const std::vector<Point<2>>& crossings_;
  Unite unite_;
  double same_crossing_;  // distance within which a crossing has the position of another point
  DomainGraph graph_;
  std::vector<GivenPoint> given_;
  std::vector<Point<2>> positions_;
  std::vector<std::int32_t> first_point_;  // first point of each source, as an index into given_
  std::vector<std::int32_t> root_;         // per point: itself, or the point that it was joined to
  std::vector<std::int32_t> vertex_of_;    // per point
  std::vector<std::int32_t> splitting_;    // vertices that split the edges they lie on
};

}  // namespace

double domain_size(const std::vector<CurveSource>& sources) {
  Box<2> box = empty_box<2>();
  for (const CurveSource& source : sources) {
    for (const Point<2>& point : source.points) include(box, point);
  }
  return size_of(box);
}

DomainGraph join_sources(const std::vector<CurveSource>& sources,
                         const std::vector<FixedNode<2>>& fixed_nodes,
                         const std::vector<Point<2>>& crossings, Unite unite, double size) {
  return Joiner(sources, fixed_nodes, crossings, unite, size).run();
}

std::string vertex_name(const GraphVertex& vertex, const std::vector<CurveSource>& sources,
                        const std::vector<FixedNode<2>>& fixed_nodes) {
  if (vertex.is_only_crossing()) return "a crossing of curves";
  if (vertex.source < 0) return fixed_nodes[vertex.fixed].name;
  return sources[vertex.source].point_name(vertex.index);
}

namespace {

// The segments at a vertex: the other ends and the tags of the first two.
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
    if (chain.closed) graph.corners[chain.vertices.front()] = 1;  // a closed chain needs one corner
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
