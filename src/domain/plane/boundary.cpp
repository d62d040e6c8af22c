// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/warning.hpp"
#include "domain/plane/curve_track.hpp"
#include "geometry/plane/faces.hpp"
#include "geometry/plane/plane_sweep.hpp"
#include "geometry/plane/point_tree.hpp"
#include "method/constants.hpp"
#include "predicates/plane.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {
namespace {

// Number of locations that a warning names.
constexpr std::size_t kNamedWorst = 3;

// A location at which d does not resolve the boundary.
struct Worst {
  double ratio;
  std::int32_t which;
  double distance, spacing;
  Point<2> at{};
  bool operator<(const Worst& other) const {
    return std::pair(ratio, which) < std::pair(other.ratio, other.which);
  }
};

// Returns a list of the worst locations; name(which) returns the name of one. On a sphere, lengths
// are measured along the sphere. Positions are included because users do not know the numbers of
// curves read from files.
template <class Name>
MessageText worst_text(std::vector<Worst>& all, const char* length, const Embedding<2>& embedding,
                       const Name& name) {
  std::sort(all.begin(), all.end());
  std::vector<MessageText> names;
  for (const Worst& worst : all) {
    if (names.size() == kNamedWorst) break;
    const auto measured = [&](double chart_length) {
      return rounded_text(embedding.measured_length(worst.at, chart_length));
    };
    names.push_back(name(worst.which) + " (" + length + " " + measured(worst.distance) +
                    ", spacing " + measured(worst.spacing) + ", at " + point_text(worst.at) + ")");
  }
  return list_text(names, kNamedWorst);
}

// Composes a warning from `begin`, the worst locations and `end`.
template <class Name>
Warning warning_of_worst(WarningCode code, const std::string& begin, std::vector<Worst>& all,
                         const char* length, const Embedding<2>& embedding, const Name& name,
                         const std::string& end = "") {
  MessageText text = begin + worst_text(all, length, embedding, name) + end;
  return {code, std::move(text), std::ssize(all), all.front().ratio};
}

// Returns advice if a large part of the boundary has short edges, where no d gives a good mesh.
std::string advice_on_short_edges(std::size_t count, std::size_t edges) {
  constexpr std::size_t kSome = 100, kPart = 10;
  if (count < kSome || kPart * count < edges) return "";
  return ". That is much of the boundary, which has " + std::to_string(edges) +
         " edges: nodes and triangles beside it cannot follow d; leave out vertices (simplify), "
         "set the angle that makes a corner (corner_angle), or use a smaller d";
}

constexpr int kMaxRounds = 64;  // rounds of halving

// An edge as the interval from node `step` of a curve to the next node.
struct EdgePlace {
  std::int32_t curve;
  std::int32_t step;
};

class BoundaryDiscretizer {
 public:
  BoundaryDiscretizer(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing,
                      std::int64_t max_nodes)
      : domain_(domain), spacing_(spacing) {
    for (const BoundaryCurve& curve : domain.curves()) tracks_.emplace_back(curve);
    stations_ = equal_step_stations(tracks_, spacing, max_nodes);
    if (domain.closing()) leave_one_triangle();
    inner_points_.resize(tracks_.size());
    for (std::size_t c = 0; c < tracks_.size(); ++c) inner_points_[c] = points_between(c);
    halved_.assign(tracks_.size(), 0);
  }

  Boundary run() {
    for (int round = 0;; ++round) {
      assemble();
      const std::vector<std::int32_t> bad = inconsistent_edges();
      if (bad.empty()) break;
      if (round == kMaxRounds || !halve(bad)) reject(bad);
    }
    find_middles();
    warn_of_halved_edges();
    ask_spacing();
    require_resolvable_boundary();
    warn_of_short_edges();
    warn_of_close_edges();
    warn_of_close_fixed_nodes();
    return std::move(boundary_);
  }

 private:
  // Leaves the triangle that closes a whole sphere without nodes between its corners, however small
  // d is there.
  void leave_one_triangle() {
    for (std::size_t c = 0; c < tracks_.size(); ++c)
      if (tracks_[c].curve().bounds()) stations_[c] = {stations_[c].front(), stations_[c].back()};
  }

  std::vector<Point<2>> points_between(std::size_t curve) const {
    const std::vector<double>& stations = stations_[curve];
    return tracks_[curve].points_at({stations.begin() + 1, stations.end() - 1});
  }

  // ------------------------------------------------------------ nodes and edges
  void assemble() {
    boundary_ = {};
    boundary_.embedding = domain_.embedding();
    places_.clear();
    for (const Corner& corner : domain_.corners()) {
      boundary_.nodes.push_back({corner.position, corner.tag});
    }
    for (std::size_t c = 0; c < tracks_.size(); ++c) assemble_curve(static_cast<std::int32_t>(c));
    boundary_.first_fixed = static_cast<std::int64_t>(boundary_.nodes.size());
    for (const FixedNode<2>& node : domain_.fixed_nodes()) {
      boundary_.nodes.push_back({node.position, node.tag});
    }
    positions_.clear();
    ends_.clear();
    for (const BoundaryNode<2>& node : boundary_.nodes) positions_.push_back(node.position);
    for (const BoundaryEdge& edge : boundary_.facets) ends_.push_back({edge.begin, edge.end});
  }

  void assemble_curve(std::int32_t c) {
    const BoundaryCurve& curve = tracks_[c].curve();
    auto begin = static_cast<std::int32_t>(curve.corner_begin);
    const auto steps = static_cast<std::int32_t>(stations_[c].size()) - 1;
    for (std::int32_t step = 0; step < steps; ++step) {
      auto end = static_cast<std::int32_t>(curve.corner_end);
      if (step + 1 < steps) {
        end = static_cast<std::int32_t>(boundary_.nodes.size());
        boundary_.nodes.push_back({inner_points_[c][step], curve.tag});
      }
      boundary_.facets.push_back({begin, end, curve.tag, curve.left_inside, curve.right_inside});
      places_.push_back({c, step});
      begin = end;
    }
  }

  double begin_station(std::int32_t edge) const {
    return stations_[places_[edge].curve][places_[edge].step];
  }
  double end_station(std::int32_t edge) const {
    return stations_[places_[edge].curve][places_[edge].step + 1];
  }
  const CurveTrack& track(std::int32_t edge) const { return tracks_[places_[edge].curve]; }
  bool is_straight(std::int32_t edge) const {
    return track(edge).is_straight(begin_station(edge), end_station(edge));
  }

  // Returns the name of the segments along an edge, with the name of their tag, if it has one.
  std::string edge_name(std::int32_t edge) const {
    const CurveTrack& on = track(edge);
    const std::size_t first = on.segment_at(begin_station(edge));
    std::size_t last = std::max(first, on.segment_at(end_station(edge)));
    if (last > first && on.vertex_stations()[last] >= end_station(edge)) --last;
    const std::string* const group = domain_.names().find({1, on.curve().tag});
    return on.curve().name_of_part(first, last) + (group ? " of '" + *group + "'" : "");
  }

  // ------------------------------------------------------------ check of the edges
  // Returns the edges that cross others or that have nodes on the wrong side.
  std::vector<std::int32_t> inconsistent_edges() const {
    const SweepResult sweep = sweep_plane(positions_, ends_);
    std::vector<std::int32_t> bad;
    for (const SweepConflict& conflict : sweep.conflicts) {
      bad.push_back(conflict.edge);
      if (conflict.other >= 0) bad.push_back(conflict.other);
    }
    if (bad.empty()) bad = edges_beside(misplaced_nodes(sweep));
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    return bad;
  }

  // Returns the face of the domain that lies on a side of an edge.
  std::int32_t face(Side side) const {
    if (side == 2 * static_cast<Side>(ends_.size())) return 0;
    const BoundaryCurve& curve = track(static_cast<std::int32_t>(side / 2)).curve();
    return side % 2 == 0 ? curve.left_face : curve.right_face;
  }

  // Returns the nodes around which edges disagree on the face.
  std::vector<std::int32_t> misplaced_nodes(const SweepResult& sweep) const {
    std::vector<std::int32_t> misplaced;
    for_each_contact(positions_, ends_, sweep, [&](std::int32_t node, Side side, Side other) {
      if (face(side) == face(other)) return;
      if (misplaced.empty() || misplaced.back() != node) misplaced.push_back(node);
    });
    for (std::size_t f = 0; f < domain_.fixed_nodes().size(); ++f) {
      const auto node = static_cast<std::int32_t>(boundary_.first_fixed + static_cast<Side>(f));
      const Side side = side_left_of(node, positions_, ends_, sweep);
      if (face(side) != domain_.fixed_node_faces()[f]) misplaced.push_back(node);
    }
    return misplaced;
  }

  // Returns the edges that end in one of the nodes, or whose part of the curve may pass a node on
  // the other side than the edge does.
  std::vector<std::int32_t> edges_beside(const std::vector<std::int32_t>& nodes) const {
    if (nodes.empty()) return {};
    std::vector<Point<2>> points;
    for (const std::int32_t node : nodes) points.push_back(positions_[node]);
    const PointTree tree(std::move(points));
    std::vector<std::int32_t> result;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e) {
      if (is_straight(e)) continue;
      const double reach = track(e).deviation(begin_station(e), end_station(e));
      bool beside = false;
      tree.for_each_near(positions_[ends_[e][0]], positions_[ends_[e][1]], reach,
                         [&beside](std::int32_t, double) { beside = true; });
      if (beside) result.push_back(e);
    }
    // Straight edges are never the cause; they are returned only to be named in a message.
    return result.empty() ? edges_at(nodes) : result;
  }

  std::vector<std::int32_t> edges_at(const std::vector<std::int32_t>& nodes) const {
    std::vector<char> wanted(positions_.size(), 0);
    for (const std::int32_t node : nodes) wanted[node] = 1;
    std::vector<std::int32_t> result;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e) {
      if (wanted[ends_[e][0]] || wanted[ends_[e][1]]) result.push_back(e);
    }
    return result;
  }

  // Halves the edges on their curves. Returns false if all of them are straight parts of curves.
  bool halve(const std::vector<std::int32_t>& edges) {
    std::vector<char> changed(tracks_.size(), 0);
    for (const std::int32_t edge : edges) {
      const double begin = begin_station(edge), end = end_station(edge);
      const double middle = 0.5 * (begin + end);
      if (is_straight(edge) || middle <= begin || middle >= end) continue;
      changed[places_[edge].curve] = 1;
      ++halved_[places_[edge].curve];
      added_.push_back({places_[edge].curve, middle});
    }
    for (const auto& [curve, station] : added_) stations_[curve].push_back(station);
    added_.clear();
    bool any = false;
    for (std::size_t c = 0; c < tracks_.size(); ++c) {
      if (!changed[c]) continue;
      any = true;
      std::sort(stations_[c].begin(), stations_[c].end());
      inner_points_[c] = points_between(c);
    }
    return any;
  }

  [[noreturn]] void reject(const std::vector<std::int32_t>& edges) const {
    std::vector<std::string> names;
    for (const std::int32_t edge : edges) {
      const std::string name = edge_name(edge);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      if (names.size() == kNamedWorst) break;
    }
    throw Error(ErrorKind::domain,
                "curves are too close together to place nodes on them: " + list_text(names) +
                    (edges.empty() ? MessageText()
                                   : " near " + point_text(positions_[ends_[edges[0]][0]])));
  }

  void find_middles() {
    boundary_.middles.clear();
    for (std::size_t c = 0; c < tracks_.size(); ++c) {
      std::vector<double> between;
      for (std::size_t k = 0; k + 1 < stations_[c].size(); ++k)
        between.push_back(0.5 * (stations_[c][k] + stations_[c][k + 1]));
      for (const Point<2>& x : tracks_[c].points_at(between)) boundary_.middles.push_back(x);
    }
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e)
      if (is_straight(e))
        boundary_.middles[e] = middle_of<2>(positions_[ends_[e][0]], positions_[ends_[e][1]]);
  }

  // ------------------------------------------------------------ warnings
  void warn_of_halved_edges() {
    std::vector<std::string> names;
    std::int64_t count = 0;
    for (std::size_t c = 0; c < tracks_.size(); ++c) {
      if (halved_[c] == 0) continue;
      count += halved_[c];
      names.push_back(tracks_[c].curve().name);
    }
    if (names.empty()) return;
    boundary_.warnings.emplace_back(
        WarningCode::feature_unresolved,
        "the spacing is larger than features of the boundary: " + std::to_string(count) +
            " boundary edges that would have crossed others were halved, on " +
            list_text(names, kNamedWorst),
        count);
  }

  void ask_spacing() {
    constexpr std::int64_t kBatch = 1 << 16;
    const auto count = static_cast<std::int64_t>(positions_.size());
    d_.resize(positions_.size());
    for (std::int64_t first = 0; first < count; first += kBatch) {
      spacing_(std::min(kBatch, count - first), positions_.data() + first, d_.data() + first);
    }
  }

  // Throws Error(ErrorKind::spacing) if edges are so much shorter than d that inner nodes would see
  // far too many of them. Beyond this sum a run would take more than about a minute, or too much
  // memory.
  void require_resolvable_boundary() const {
    constexpr double kFine = 32, kMax = 3e7;
    // Weight of edges when d leaves no room for inner nodes: each boundary node is then tested
    // against all others, often with exact arithmetic.
    constexpr double kNothingWithin = 20;
    const double size = size_of(domain_.bounds());  // bubbles are not larger than the domain
    double sum = 0, work = 0, finest = 0;
    std::int64_t fine = 0;
    std::int32_t worst = 0;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e) {
      const auto [a, b] = ends_[e];
      const double d = std::min(0.5 * (d_[a] + d_[b]), size);
      const double ratio = d / distance<2>(positions_[a], positions_[b]);
      if (ratio <= kFine) continue;
      if (ratio > finest) finest = ratio, worst = e;
      sum += ratio;
      work += d > 0.4 * size ? kNothingWithin * ratio : ratio;
      ++fine;
    }
    if (work <= kMax) return;
    throw Error(ErrorKind::spacing,
                "the boundary is far finer than the spacing: " + std::to_string(fine) +
                    " of its edges are " + rounded_text(sum / static_cast<double>(fine)) +
                    " times shorter than d, such as " + edge_name(worst) + " at " +
                    point_text(positions_[ends_[worst][0]]) +
                    "; use a smaller d, leave out vertices (simplify), or set "
                    "the angle that makes a corner (corner_angle): between corners, nodes are "
                    "placed at distances of d");
  }

  void warn_of_short_edges() {
    std::vector<Worst> all;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e) {
      const auto [a, b] = ends_[e];
      const double length = distance<2>(positions_[a], positions_[b]);
      const double d = 0.5 * (d_[a] + d_[b]);
      if (length < 0.5 * d) all.push_back({length / d, e, length, d, positions_[a]});
    }
    if (all.empty()) return;
    boundary_.warnings.push_back(warning_of_worst(
        WarningCode::feature_unresolved,
        "the spacing is larger than features of the boundary at " + std::to_string(all.size()) +
            " boundary edges shorter than half of it; the worst: ",
        all, "length", domain_.embedding(), [this](std::int32_t e) { return edge_name(e); },
        advice_on_short_edges(all.size(), ends_.size())));
  }

  // Warns of nodes close to an edge across the inside, as at a slit or a sharp corner. Nodes of
  // short edges are excluded because warn_of_short_edges covers them.
  void warn_of_close_edges() {
    constexpr double kClose = 0.1;
    const auto is_short = [&](std::int32_t a, std::int32_t b) {
      return distance<2>(positions_[a], positions_[b]) < 0.25 * (d_[a] + d_[b]);
    };
    std::vector<char> at_short_edge(positions_.size(), 0);
    for (const auto& [a, b] : ends_)
      if (is_short(a, b)) at_short_edge[a] = at_short_edge[b] = 1;
    const PointTree tree({positions_.begin(), positions_.begin() + boundary_.first_fixed});
    std::vector<Worst> nearest(positions_.size(), {HUGE_VAL, 0, 0, 0});
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(ends_.size()); ++e) {
      const std::int32_t a = ends_[e][0], b = ends_[e][1];
      if (is_short(a, b)) continue;
      tree.for_each_near(positions_[a], positions_[b], kClose * std::max(d_[a], d_[b]),
                         [&](std::int32_t node, double distance) {
                           const double d = d_[node];
                           if (node == a || node == b || at_short_edge[node] != 0 ||
                               distance >= kClose * d || !faces_inside(e, node))
                             return;
                           nearest[node] = std::min(
                               nearest[node], {distance / d, e, distance, d, positions_[node]});
                         });
    }
    std::erase_if(nearest, [](const Worst& worst) { return worst.ratio == HUGE_VAL; });
    if (nearest.empty()) return;
    boundary_.warnings.push_back(warning_of_worst(
        WarningCode::feature_unresolved,
        "the spacing is larger than features of the boundary at " + std::to_string(nearest.size()) +
            " boundary nodes closer than a tenth of it to another edge; the worst: beside ",
        nearest, "distance", domain_.embedding(), [this](std::int32_t e) { return edge_name(e); }));
  }

  // Returns true if the domain lies on the side of the edge on which the node lies.
  bool faces_inside(std::int32_t edge, std::int32_t node) const {
    const int side =
        orientation(positions_[ends_[edge][0]], positions_[ends_[edge][1]], positions_[node]);
    const BoundaryCurve& curve = track(edge).curve();
    return side > 0 ? curve.left_inside : side < 0 && curve.right_inside;
  }

  void warn_of_close_fixed_nodes() {
    const std::vector<FixedNode<2>>& fixed = domain_.fixed_nodes();
    if (fixed.empty()) return;
    std::vector<Point<2>> points;
    for (const FixedNode<2>& node : fixed) points.push_back(node.position);
    const PointTree tree(std::move(points));
    std::vector<Worst> nearest(fixed.size(), {HUGE_VAL, 0, 0, 0});
    const auto look = [&](const Point<2>& a, const Point<2>& b, double d, std::int32_t self) {
      tree.for_each_near(a, b, 0.8 * d, [&](std::int32_t f, double distance) {
        const double own = d_[boundary_.first_fixed + f];
        if (f == self || distance >= 0.4 * own) return;
        nearest[f] = std::min(nearest[f], {distance / own, f, distance, own, fixed[f].position});
      });
    };
    for (const auto& [a, b] : ends_) {
      look(positions_[a], positions_[b], std::max(d_[a], d_[b]), -1);
    }
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(fixed.size()); ++f) {
      look(fixed[f].position, fixed[f].position, d_[boundary_.first_fixed + f], f);
    }
    // Nodes of the patch that closes a sphere are close to each other only in the chart.
    std::erase_if(nearest, [&](const Worst& worst) {
      return worst.ratio == HUGE_VAL || domain_.is_in_patch(worst.at);
    });
    if (nearest.empty()) return;
    boundary_.warnings.push_back(warning_of_worst(
        WarningCode::fixed_nodes_close,
        std::to_string(nearest.size()) +
            " fixed nodes are closer than 0.4 of the spacing to the boundary or to each other; the "
            "worst: ",
        nearest, "distance", domain_.embedding(),
        [&fixed](std::int32_t f) { return fixed[f].name; }));
  }

  const PlaneDomain& domain_;
  const SpacingEvaluator<2>& spacing_;
  std::vector<CurveTrack> tracks_;
  std::vector<std::vector<double>> stations_;           // of the nodes of each curve, ends included
  std::vector<std::vector<Point<2>>> inner_points_;     // of the nodes of each curve, ends excluded
  std::vector<std::int64_t> halved_;                    // number of halved edges of each curve
  std::vector<std::pair<std::int32_t, double>> added_;  // curve and station of each new node
  Boundary boundary_;
  std::vector<EdgePlace> places_;  // curve and step of each edge
  std::vector<Point<2>> positions_;
  std::vector<VertexPair> ends_;
  std::vector<double> d_;  // at the nodes
};

}  // namespace

std::vector<double> bubbles_on_boundary(const Boundary& boundary) {
  std::vector<double> longest(boundary.nodes.size(), 0);
  for (const BoundaryEdge& e : boundary.facets) {
    const auto a = static_cast<std::size_t>(e.begin), b = static_cast<std::size_t>(e.end);
    const double length = distance<2>(boundary.nodes[a].position, boundary.nodes[b].position);
    for (const std::size_t node : {a, b}) longest[node] = std::max(longest[node], length);
  }
  for (double& bound : longest)
    bound = bound > 0 ? method::kBubbleOfEdges * bound : HUGE_VAL;  // fixed nodes
  return longest;
}

Boundary discretize_boundary(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing,
                             std::int64_t max_nodes) {
  return BoundaryDiscretizer(domain, spacing, max_nodes).run();
}

}  // namespace pnpbs
