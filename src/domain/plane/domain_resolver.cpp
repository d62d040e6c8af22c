// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/domain_resolver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "domain/domain_size.hpp"
#include "domain/plane/conflicts.hpp"
#include "domain/plane/curve_crossings.hpp"
#include "domain/plane/curve_solids.hpp"
#include "domain/plane/domain_graph.hpp"
#include "domain/plane/plane_domain.hpp"
#include "domain/plane/sampling.hpp"
#include "domain/region_points.hpp"
#include "geometry/even_odd.hpp"
#include "geometry/plane/faces.hpp"
#include "geometry/plane/plane_sweep.hpp"
#include "geometry/plane/point_tree.hpp"
#include "predicates/expansion.hpp"

namespace pnpbs {
namespace {

using Kind = CurveSource::Kind;

struct Sample {
  double parameter;
  Point<2> point;
};

// New samples of one curve, each with the index of the old sample that precedes it.
using NewSamples = std::vector<std::pair<std::int64_t, Sample>>;

void insert(CurveSource& curve, NewSamples& added) {
  const bool rising = curve.parameters.front() < curve.parameters.back();
  std::stable_sort(added.begin(), added.end(), [rising](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const double ta = a.second.parameter, tb = b.second.parameter;
    return rising ? ta < tb : ta > tb;
  });
  std::vector<double> parameters;
  std::vector<Point<2>> points;
  std::size_t next = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    parameters.push_back(curve.parameters[i]);
    points.push_back(curve.points[i]);
    for (; next < added.size() && added[next].first == static_cast<std::int64_t>(i); ++next) {
      if (added[next].second.parameter == parameters.back()) continue;
      parameters.push_back(added[next].second.parameter);
      points.push_back(added[next].second.point);
    }
  }
  curve.parameters = std::move(parameters);
  curve.points = std::move(points);
}

// A point at which a smooth curve gets a sample if the curve passes through it.
struct Attachable {
  Point<2> point;
  double same;  // largest distance that counts as the same position
};

std::vector<Attachable> attachables(const std::vector<CurveSource>& sources,
                                    const std::vector<FixedNode<2>>& fixed_nodes,
                                    const std::vector<Point<2>>& crossings, double size) {
  std::vector<Attachable> result;
  for (const CurveSource& source : sources) {
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(source.points.size()); ++i) {
      const bool end = source.ends_at(i);
      if (source.kind == Kind::smooth && !end) continue;
      result.push_back({source.points[i], (end ? kSameCurveEnd : kSamePoint) * size});
    }
  }
  for (const FixedNode<2>& node : fixed_nodes) result.push_back({node.position, kSamePoint * size});
  for (const Point<2>& crossing : crossings) result.push_back({crossing, kSamePoint * size});
  return result;
}

// Largest distance between a chord and its curve, except at kinks, where chords are tiny. [length
// of the chord]
constexpr double kMaxSag = 0.02;

void attach(CurveSource& curve, const std::vector<Attachable>& all, const PointTree& tree) {
  NewSamples added;
  for (std::int64_t i = 0; i + 1 < static_cast<std::int64_t>(curve.points.size()); ++i) {
    const Point<2>&a = curve.points[i], &b = curve.points[i + 1];
    tree.for_each_near(a, b, kMaxSag * distance<2>(a, b), [&](std::int32_t which, double) {
      const auto& [point, same] = all[which];
      if (distance<2>(point, a) <= same || distance<2>(point, b) <= same) return;
      const double t =
          parameter_beside(curve.evaluate, curve.parameters[i], curve.parameters[i + 1], point);
      Point<2> there;
      curve.evaluate(1, &t, &there);
      if (distance<2>(point, there) <= same) added.push_back({i, {t, point}});
    });
  }
  if (!added.empty()) insert(curve, added);
}

// Adds vertices, curve ends, fixed nodes and crossings that lie on smooth curves to the samples of
// these curves.
void attach_to_smooth_curves(std::vector<CurveSource>& sources,
                             const std::vector<FixedNode<2>>& fixed_nodes,
                             const std::vector<Point<2>>& crossings, double size) {
  const bool any = std::any_of(sources.begin(), sources.end(), [](const CurveSource& source) {
    return source.kind == Kind::smooth;
  });
  if (!any) return;
  const std::vector<Attachable> all = attachables(sources, fixed_nodes, crossings, size);
  std::vector<Point<2>> points;
  for (const Attachable& attachable : all) points.push_back(attachable.point);
  const PointTree tree(std::move(points));
  for (CurveSource& source : sources) {
    if (source.kind == Kind::smooth) attach(source, all, tree);
  }
}

// Halves the chords of smooth curves among these edges, -1 for none. Returns false if there are
// none.
template <class EdgePairs>
bool refine_chords(std::vector<CurveSource>& sources, const DomainGraph& graph,
                   const EdgePairs& pairs) {
  std::vector<NewSamples> added(sources.size());
  const auto halve = [&](std::int32_t e) {
    const GraphEdge& edge = graph.edges[e];
    const CurveSource& curve = sources[edge.source];
    if (curve.kind != Kind::smooth) return;
    const double t =
        0.5 * curve.parameters[edge.segment] + 0.5 * curve.parameters[edge.segment + 1];
    const Point<2> point = curve_points(curve.evaluate, {t}, curve.segment_name(0))[0];
    added[edge.source].push_back({edge.segment, {t, point}});
  };
  for (const std::array<std::int32_t, 2>& pair : pairs)
    for (const std::int32_t edge : pair)
      if (edge >= 0) halve(edge);
  bool any = false;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (added[s].empty()) continue;
    insert(sources[s], added[s]);
    any = true;
  }
  return any;
}

// Returns the pairs of edges in conflict; the second is -1 for a vertex on an edge.
std::vector<std::array<std::int32_t, 2>> edges_in(const std::vector<SweepConflict>& conflicts) {
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (const SweepConflict& conflict : conflicts) pairs.push_back({conflict.edge, conflict.other});
  return pairs;
}

struct Extent {
  Box<2> bounds;
  double area;
};

// Returns points of the true curve, at parameters halfway between its samples.
std::vector<Point<2>> middles(const BoundaryCurve& curve) {
  std::vector<double> t;
  for (std::size_t i = 0; i + 1 < curve.parameters.size(); ++i) {
    t.push_back(0.5 * curve.parameters[i] + 0.5 * curve.parameters[i + 1]);
  }
  return curve_points(curve.evaluate, t, curve.name);
}

// Returns bounding box and area from the curves that have the inside on one side. Between the
// samples of a smooth curve, the area is that under a parabola through the middle point.
Extent extent_of(const std::vector<BoundaryCurve>& curves) {
  Box<2> box = empty_box<2>();
  for (const BoundaryCurve& curve : curves) {
    for (const Point<2>& point : curve.points) include(box, point);
  }
  const Point<2> origin = box.low;
  TwoTerms sum{0, 0};  // of twice the area
  const auto add = [&sum](double term) {
    const TwoTerms next = two_sum(sum.high, term);
    sum = {next.high, sum.low + next.low};
  };
  const auto cross = [&origin](const Point<2>& a, const Point<2>& b) {
    return (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
  };
  for (const BoundaryCurve& curve : curves) {
    const double sign = int{curve.left_inside} - int{curve.right_inside};
    const auto& p = curve.points;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) add(sign * cross(p[i], p[i + 1]));
    if (!curve.evaluate) continue;
    const std::vector<Point<2>> middle = middles(curve);
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      // The area between chord and parabola is 4/3 of the triangle's area.
      const double triangle = (middle[i][0] - p[i][0]) * (p[i + 1][1] - p[i][1]) -
                              (middle[i][1] - p[i][1]) * (p[i + 1][0] - p[i][0]);
      add(sign * 4 / 3 * triangle);
      // The curve extends beyond the middle point by less than the middle point is from the chord.
      const double sag_x = middle[i][0] - 0.5 * (p[i][0] + p[i + 1][0]);
      const double sag_y = middle[i][1] - 0.5 * (p[i][1] + p[i + 1][1]);
      include(box, {middle[i][0] + sag_x, middle[i][1] + sag_y});
    }
  }
  return {box, 0.5 * (sum.high + sum.low)};
}

// Rounds of halving the chords of smooth curves in conflict, because the curves themselves may not
// be, before the conflict is real.
constexpr int kRefinements = 8;

// Most rounds in which curves are split where they cross. Mostly one suffices. Where rounding bends
// edges, they can cross again.
constexpr int kMostSplittings = 20;

// Builds the index from chords of smooth curves, since nodes keep farther from the curves than the
// chords do.
std::shared_ptr<const RegionIndex<2>> regions_of(const std::vector<BoundaryCurve>& curves) {
  std::vector<RegionFacet<2>> facets;
  for (const BoundaryCurve& curve : curves)
    for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
      facets.push_back({{curve.points[p], curve.points[p + 1]},
                        {curve.left_inside, curve.right_inside},
                        {curve.left_region, curve.right_region}});
  return std::make_shared<const RegionIndex<2>>(std::move(facets));
}

class Resolver {
 public:
  Resolver(std::vector<CurveSource>& sources, const std::vector<RegionPoint<2>>& region_points,
           const std::vector<FixedNode<2>>& fixed_nodes, std::optional<OverlapRule> fragment,
           bool split)
      : sources_(sources),
        region_points_(region_points),
        fixed_nodes_(fixed_nodes),
        fragment_(fragment),
        split_(split) {}

  ResolvedDomain run() {
    make_graph();
    std::vector<std::int32_t> solid_tags;  // per face; empty if curves do not meet
    if (fragment_) {
      const CurveSolids solids(sources_, graph_);
      split_curves();
      require_no_conflicts();
      faces_ = find_faces(points_, graph_.ends, sweep_);
      solid_tags = find_inside_of_solids(solids.around(graph_, faces_), *fragment_);
    } else if (split_) {
      split_curves();
    } else if (!sweep_.conflicts.empty()) {
      solid_tags = unite_touching_curves();
    }
    if (solid_tags.empty()) find_inside();
    const auto face_of = [this](std::size_t k) { return face_of_point(k); };
    remove_holes(region_points_, face_of, inside_, result_.warnings);
    region_tags_ = tags_of_parts(region_points_, face_of, inside_, result_.warnings);
    if (!solid_tags.empty()) region_tags_.resize(inside_.size(), 0);
    for (std::size_t face = 0; face < solid_tags.size(); ++face)
      if (region_tags_[face] == 0) region_tags_[face] = solid_tags[face];
    number_inner_faces();
    keep_edges();
    add_isolated_vertices();
    make_curves();
    make_corners();
    const Extent extent = extent_of(result_.curves);
    result_.bounds = extent.bounds;
    result_.area = extent.area;
    if (!region_tags_.empty()) result_.regions = regions_of(result_.curves);
    return std::move(result_);
  }

 private:
  // ------------------------------------------------------------ the graph
  void make_graph() {
    std::int64_t segments = 0;
    for (const CurveSource& source : sources_) segments += source.segment_count();
    if (segments == 0) reject_domain("the domain has no curves");
    const double size = domain_size(sources_);
    require_domain_size(size);
    for (const CurveSource& source : sources_)
      for (const Point<2>& point : source.points) require_near_origin<2>(size, point);
    attach_to_smooth_curves(sources_, fixed_nodes_, {}, size);
    for (int round = 0;; ++round) {
      join(Unite::none, size);
      if (round == kRefinements) break;
      if (!refine_chords(sources_, graph_, edges_in(sweep_.conflicts))) break;
    }
  }

  void join(Unite unite, double size) {
    graph_ = join_sources(sources_, fixed_nodes_, crossings_, unite, size);
    points_.clear();
    for (const GraphVertex& vertex : graph_.vertices) points_.push_back(vertex.position);
    for (const RegionPoint<2>& point : region_points_) points_.push_back(point.point);
    sweep_ = sweep_plane(points_, graph_.ends);
  }

  void require_no_conflicts() const {
    reject_conflicts({sources_, region_points_, fixed_nodes_, graph_, points_, sweep_});
  }

  bool has_conflicts() const {
    return !sweep_.conflicts.empty() ||
           std::ranges::any_of(sweep_.coincident, [this](const VertexPair& pair) {
             return index(pair[0]) < graph_.vertices.size() &&
                    index(pair[1]) < graph_.vertices.size();
           });
  }

  // ------------------------------------------------------------ solids
  // Splits curves where they meet.
  void split_curves() {
    const double size = graph_.size;
    for (int round = 0; round < kMostSplittings && has_conflicts(); ++round) {
      const auto pairs = crossing_edges(graph_, points_);
      if (round > 0 && pairs.empty()) break;
      if (round >= kRefinements || !refine_chords(sources_, graph_, pairs)) {
        for (const auto& [edge, other] : pairs)
          crossings_.push_back(meeting_point(sources_, graph_, points_, edge, other));
        attach_to_smooth_curves(sources_, fixed_nodes_, crossings_, size);
      }
      join(Unite::all, size);
    }
  }

  // Unites edges of different curves that lie on each other, if this leaves no conflicts and no
  // solids overlap, and returns the tag of each face. Otherwise changes nothing and returns none.
  std::vector<std::int32_t> unite_touching_curves() {
    const CurveSolids solids(sources_, graph_);
    DomainGraph given = graph_;
    SweepResult given_sweep = sweep_;
    join(Unite::of_different_sources, graph_.size);
    if (sweep_.conflicts.empty()) {
      faces_ = find_faces(points_, graph_.ends, sweep_);
      const auto around = solids.around(graph_, faces_);
      const auto most = std::ranges::max(around, {}, [](const auto& in) { return in.size(); });
      if (most.size() == 1) return find_inside_of_solids(around, OverlapRule::last);
    }
    graph_ = std::move(given);
    sweep_ = std::move(given_sweep);
    return {};
  }

  std::vector<std::int32_t> find_inside_of_solids(
      const std::vector<std::vector<std::int32_t>>& around, OverlapRule overlap) {
    inside_.clear();
    for (const std::vector<std::int32_t>& solids : around) inside_.push_back(!solids.empty());
    if (std::ranges::find(inside_, 1) == inside_.end()) reject_domain("the curves enclose nothing");
    return tags_by_solids(around, overlap).of_regions;
  }

  // Finds the inside of curves that do not meet.
  void find_inside() {
    require_no_conflicts();
    const bool graph_rule = std::any_of(sources_.begin(), sources_.end(), [](const auto& source) {
      return source.kind == Kind::graph;
    });
    if (!graph_rule) require_closed_boundary();
    faces_ = find_faces(points_, graph_.ends, sweep_);
    if (graph_rule) {
      find_inside_of_graph();
    } else {
      find_inside_of_boundary();
    }
  }

  std::string edge_name(std::int32_t edge) const {
    return sources_[graph_.edges[edge].source].segment_name(graph_.edges[edge].segment);
  }

  MessageText name_and_position(std::int32_t vertex) const {
    return vertex_name(graph_.vertices[vertex], sources_, fixed_nodes_) + " " +
           point_text(points_[vertex]);
  }

  // ------------------------------------------------------------ the boundary
  // Throws if the boundary is open: every vertex must end an even number of boundary segments.
  void require_closed_boundary() const {
    std::vector<char> odd(graph_.vertices.size(), 0);
    bool any = false;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (!is_boundary(e)) continue;
      any = true;
      for (const std::int32_t vertex : graph_.ends[e]) odd[vertex] ^= 1;
    }
    if (!any) reject_domain("the domain has no boundary curve, only inner ones");
    const auto open = std::find(odd.begin(), odd.end(), 1);
    if (open == odd.end()) return;
    reject_domain("the boundary is not closed: it ends at " +
                  name_and_position(static_cast<std::int32_t>(open - odd.begin())));
  }

  bool is_boundary(std::size_t edge) const {
    return sources_[graph_.edges[edge].source].role == CurveRole::boundary;
  }

  // ------------------------------------------------------------ the inside
  std::int32_t face_on_left(std::size_t edge) const { return faces_.of_side[2 * edge]; }
  std::int32_t face_on_right(std::size_t edge) const { return faces_.of_side[2 * edge + 1]; }
  std::int32_t face_around(std::int32_t vertex) const {
    return faces_.of_side[side_left_of(vertex, points_, graph_.ends, sweep_)];
  }

  // Marks all enclosed faces as inside, the rule of Triangle.
  void find_inside_of_graph() {
    inside_.assign(faces_.count, 1);
    inside_[0] = 0;
    if (faces_.count > 1) return;
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      if (graph_.vertices[v].degree != 1) continue;
      reject_domain("the segments enclose nothing: they end at " +
                    name_and_position(static_cast<std::int32_t>(v)));
    }
    reject_domain("the segments enclose nothing");
  }

  void find_inside_of_boundary() {
    std::vector<RegionContact> contacts;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      contacts.push_back({face_on_left(e), face_on_right(e), is_boundary(e)});
    inside_ = inside_by_parity(faces_.count, contacts);
  }

  // Returns the face in which region point k lies.
  std::int32_t face_of_point(std::size_t k) const {
    return face_around(static_cast<std::int32_t>(graph_.vertices.size() + k));
  }

  void number_inner_faces() {
    inner_face_.assign(faces_.count, 0);
    std::int32_t count = 0;
    for (std::int32_t face = 0; face < faces_.count; ++face) {
      if (inside_[face]) inner_face_[face] = ++count;
    }
  }

  // ------------------------------------------------------------ edges and vertices of the domain
  void keep_edges() {
    kept_.resize(graph_.edges.size());
    kept_degree_.assign(graph_.vertices.size(), 0);
    std::vector<std::string> left_out;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      kept_[e] = inside_[face_on_left(e)] || inside_[face_on_right(e)];
      if (kept_[e]) {
        for (const std::int32_t vertex : graph_.ends[e]) ++kept_degree_[vertex];
        continue;
      }
      if (sources_[graph_.edges[e].source].number < 0) continue;  // a flat side within a hole
      const std::string name = edge_name(static_cast<std::int32_t>(e));
      if (left_out.empty() || left_out.back() != name) left_out.push_back(name);
    }
    if (left_out.empty()) return;
    result_.warnings.emplace_back(WarningCode::left_out_outside,
                                  "outside the domain and left out: " + list_text(left_out, 5),
                                  std::ssize(left_out));
  }

  // Adds fixed nodes that lie on no curve, and vertices of graphs without segments, to the fixed
  // nodes.
  void add_isolated_vertices() {
    std::vector<std::string> unused, outside;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(graph_.vertices.size()); ++v) {
      const GraphVertex& vertex = graph_.vertices[v];
      if (kept_degree_[v] > 0) continue;
      const bool in_face = vertex.degree == 0 && inside_[face_around(v)];
      if (!in_face && vertex.fixed >= 0) {
        reject_domain(fixed_nodes_[vertex.fixed].name + " at " + point_text(vertex.position) +
                      " lies outside the domain");
      }
      if (vertex.degree > 0 || vertex.is_only_crossing()) continue;
      const std::string name = vertex_name(vertex, sources_, fixed_nodes_);
      if (vertex.fixed < 0) (in_face ? unused : outside).push_back(name);
      if (!in_face) continue;
      const std::int32_t tag = vertex.tag != 0 ? vertex.tag : 1;
      result_.fixed_nodes.push_back({vertex.position, tag, name});
      result_.fixed_node_faces.push_back(inner_face_[face_around(v)]);
    }
    if (!unused.empty()) {
      result_.warnings.emplace_back(WarningCode::unused_vertices,
                                    "in no segment, taken as fixed nodes: " + list_text(unused, 5),
                                    std::ssize(unused));
    }
    if (!outside.empty()) {
      result_.warnings.emplace_back(
          WarningCode::unused_vertices,
          "in no segment, outside the domain and left out: " + list_text(outside, 5),
          std::ssize(outside));
    }
  }

  // ------------------------------------------------------------ curves between corners
  void make_curves() {
    std::size_t first = 0;
    while (first < graph_.edges.size()) {
      std::size_t end = first;
      while (end < graph_.edges.size() && graph_.edges[end].source == graph_.edges[first].source) {
        ++end;
      }
      cut_at_corners(first, end);
      first = end;
    }
  }

  bool begins_at_corner(std::size_t edge) const {
    return graph_.vertices[graph_.ends[edge][0]].corner;
  }

  // Cuts the edges of one source into curves. A closed source starts at its first corner.
  void cut_at_corners(std::size_t first, std::size_t end) {
    std::size_t start = first;
    while (start < end && !begins_at_corner(start)) ++start;
    if (start == end) {
      start = first;
      graph_.vertices[graph_.ends[start][0]].corner = true;
    }
    std::vector<std::size_t> chain;
    for (std::size_t k = 0; k < end - first; ++k) {
      const std::size_t edge = first + (start - first + k) % (end - first);
      if (!chain.empty() && begins_at_corner(edge)) {
        add_curve(chain);
        chain.clear();
      }
      if (kept_[edge]) chain.push_back(edge);
    }
    if (!chain.empty()) add_curve(chain);
  }

  void add_curve(const std::vector<std::size_t>& chain) {
    const std::size_t first = chain.front(), last = chain.back();
    const CurveSource& source = sources_[graph_.edges[first].source];
    BoundaryCurve curve;
    curve.points.push_back(points_[graph_.ends[first][0]]);
    for (const std::size_t edge : chain) curve.points.push_back(points_[graph_.ends[edge][1]]);
    if (source.kind == Kind::smooth) {
      curve.evaluate = source.evaluate;
      curve.parameters.push_back(graph_.edges[first].t_begin);
      for (const std::size_t edge : chain) curve.parameters.push_back(graph_.edges[edge].t_end);
    }
    // Vertices, until make_corners() numbers the corners.
    curve.corner_begin = graph_.ends[first][0];
    curve.corner_end = graph_.ends[last][1];
    curve.tag = source.segment_tag(graph_.edges[first].segment);
    curve.source = graph_.edges[first].source;
    curve.left_face = inner_face_[face_on_left(first)];
    curve.right_face = inner_face_[face_on_right(first)];
    if (!region_tags_.empty()) {
      curve.left_region = region_tags_[face_on_left(first)];
      curve.right_region = region_tags_[face_on_right(first)];
    }
    curve.left_inside = curve.left_face > 0;
    curve.right_inside = curve.right_face > 0;
    name(curve, source, chain);
    result_.curves.push_back(std::move(curve));
  }

  void name(BoundaryCurve& curve, const CurveSource& source,
            const std::vector<std::size_t>& chain) const {
    curve.name = source.segments_name(graph_.edges[chain.front()].segment,
                                      graph_.edges[chain.back()].segment);
    if (source.kind == Kind::smooth) return;
    curve.name_prefix = source.name_prefix();
    curve.reordered = !source.segment_numbers.empty();
    for (const std::size_t edge : chain)
      curve.segment_numbers.push_back(source.shown_segment_number(graph_.edges[edge].segment));
  }

  void make_corners() {
    std::vector<std::int32_t> tag_there(graph_.vertices.size(), 0);
    for (const BoundaryCurve& curve : result_.curves) {
      for (const std::int64_t vertex : {curve.corner_begin, curve.corner_end}) {
        if (tag_there[vertex] == 0) tag_there[vertex] = curve.tag;
      }
    }
    std::vector<std::int64_t> number(graph_.vertices.size(), -1);
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      if (tag_there[v] == 0) continue;
      const GraphVertex& vertex = graph_.vertices[v];
      number[v] = static_cast<std::int64_t>(result_.corners.size());
      result_.corners.push_back({vertex.position, vertex.tag != 0 ? vertex.tag : tag_there[v],
                                 vertex_name(vertex, sources_, fixed_nodes_)});
    }
    for (BoundaryCurve& curve : result_.curves) {
      curve.corner_begin = number[curve.corner_begin];
      curve.corner_end = number[curve.corner_end];
    }
  }

  std::vector<CurveSource>& sources_;
  const std::vector<RegionPoint<2>>& region_points_;
  const std::vector<FixedNode<2>>& fixed_nodes_;
  std::optional<OverlapRule> fragment_;
  bool split_;
  std::vector<Point<2>> crossings_;  // found so far
  DomainGraph graph_;
  std::vector<Point<2>> points_;  // vertices of the graph, then region points
  SweepResult sweep_;
  Faces faces_;
  std::vector<char> inside_;               // per face
  std::vector<std::int32_t> inner_face_;   // per face: its number among the inner ones, or 0
  std::vector<std::int32_t> region_tags_;  // per face; empty if none exist
  std::vector<char> kept_;                 // per edge: is it part of the domain?
  std::vector<std::int32_t> kept_degree_;
  ResolvedDomain result_;
};

}  // namespace

ResolvedDomain resolve_domain(std::vector<CurveSource>& sources,
                              const std::vector<RegionPoint<2>>& region_points,
                              const std::vector<FixedNode<2>>& fixed_nodes,
                              std::optional<OverlapRule> fragment, bool split) {
  return Resolver(sources, region_points, fixed_nodes, fragment, split).run();
}

}  // namespace pnpbs
