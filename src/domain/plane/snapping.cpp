// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/snapping.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "domain/plane/domain_graph.hpp"
#include "domain/plane/sampling.hpp"
#include "geometry/plane/point_tree.hpp"
#include "geometry/plane/segments.hpp"

namespace pnpbs {
namespace {

using Kind = CurveSource::Kind;

constexpr std::int32_t kFixedNodes = -1;  // stands for a source

// A point of a source, or a fixed node.
struct SourcePoint {
  std::int32_t source = kFixedNodes;
  std::int64_t index = 0;
  auto operator<=>(const SourcePoint&) const = default;
};

// A position that a point may be moved to.
struct Target {
  double distance = HUGE_VAL;
  Point<2> position{};
  SourcePoint vertex{};  // not used for curves
  std::string name;
};

// Kind of target in a pass over all points. Vertices that may be moved themselves are last, since
// they may have to be moved onto a curve before.
enum class Onto { vertex, curve, loose_vertex };

// A point that may be moved.
struct LoosePoint {
  SourcePoint given;
  std::optional<std::int64_t> neighbour;  // index of the other end of its segment
  Target vertex, loose_vertex, curve;     // the nearest ones
};

// The move of a point, for messages.
struct Move {
  Point<2> from;
  std::string onto;
};

class Snapping {
 public:
  Snapping(std::vector<CurveSource>& sources, std::vector<FixedNode<2>>& fixed_nodes, double size,
           double reach)
      : sources_(sources), fixed_nodes_(fixed_nodes), size_(size), reach_(reach) {}

  std::optional<Warning> run() {
    list_loose_points();
    if (loose_.empty()) return std::nullopt;
    // A point may be moved onto a curve whose end is moved after it.
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round)
      for (const Onto onto : {Onto::vertex, Onto::curve, Onto::loose_vertex}) {
        find_targets();
        move_points(onto);
      }
    if (moved_.empty()) return std::nullopt;
    std::vector<MessageText> moves;
    for (const auto& [given, move] : moved_)
      moves.push_back(name_of(given) + " " + point_text(move.from) + " to " + move.onto);
    return Warning(WarningCode::vertices_merged,
                   "moved onto curves that they miss by less than " + rounded_text(reach_) + ": " +
                       list_text(moves, 5),
                   std::ssize(moves), reach_);
  }

 private:
  Point<2>& position_of(const SourcePoint& given) {
    if (given.source == kFixedNodes) return fixed_nodes_[given.index].position;
    return sources_[given.source].points[given.index];
  }
  std::string name_of(const SourcePoint& given) const {
    if (given.source == kFixedNodes) return fixed_nodes_[given.index].name;
    return sources_[given.source].point_name(given.index);
  }

  void list_loose_points() {
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const auto source = static_cast<std::int32_t>(s);
      if (sources_[s].kind == Kind::graph) {
        list_dangling_vertices(source);
      } else if (!sources_[s].closed && sources_[s].points.size() > 1) {
        const std::int64_t last = std::ssize(sources_[s].points) - 1;
        add_loose({source, 0}, 1);
        add_loose({source, last}, last - 1);
      }
    }
    for (std::size_t f = 0; f < fixed_nodes_.size(); ++f)
      add_loose({kFixedNodes, static_cast<std::int64_t>(f)}, std::nullopt);
  }

  void add_loose(const SourcePoint& given, std::optional<std::int64_t> neighbour) {
    loose_.push_back({given, neighbour, {}, {}, {}});
    is_loose_.insert(given);
  }

  void list_dangling_vertices(std::int32_t source) {
    const CurveSource& graph = sources_[source];
    std::vector<std::int32_t> degree(graph.points.size(), 0);
    std::vector<std::int64_t> other(graph.points.size(), 0);
    for (const auto& [a, b] : graph.segment_ends) {
      ++degree[a], ++degree[b];
      other[a] = b, other[b] = a;
    }
    for (std::int64_t v = 0; v < std::ssize(graph.points); ++v) {
      if (degree[v] == 1) add_loose({source, v}, other[v]);
      if (degree[v] == 0) add_loose({source, v}, std::nullopt);
    }
  }

  void find_targets() {
    std::vector<Point<2>> positions;
    for (LoosePoint& loose : loose_) {
      positions.push_back(position_of(loose.given));
      loose.vertex = loose.loose_vertex = loose.curve = {};
    }
    const PointTree tree(std::move(positions));
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const CurveSource& source = sources_[s];
      for (std::int64_t i = 0; i < source.segment_count(); ++i) {
        const auto ends = source.ends(i);
        const Point<2>&a = source.points[ends[0]], &b = source.points[ends[1]];
        // Between its samples a smooth curve deviates from the chord.
        const double sag = source.kind == Kind::smooth ? kSampleTurn * distance<2>(a, b) : 0;
        tree.for_each_near(a, b, reach_ + sag, [&](std::int32_t which, double) {
          look_at(loose_[which], static_cast<std::int32_t>(s), i, ends);
        });
      }
    }
  }

  // Updates the nearest vertex and curve of a loose point by a segment.
  void look_at(LoosePoint& loose, std::int32_t s, std::int64_t segment,
               const std::array<std::int64_t, 2>& ends) {
    const CurveSource& source = sources_[s];
    const Point<2> x = position_of(loose.given);
    for (const std::int64_t end : ends) {
      const SourcePoint vertex{s, end};
      const bool is_sample = source.kind == Kind::smooth && !source.ends_at(end);
      const bool is_own = vertex == loose.given ||
                          (s == loose.given.source && loose.neighbour && *loose.neighbour == end);
      if (is_sample || is_own) continue;
      Target& target = is_loose_.contains(vertex) ? loose.loose_vertex : loose.vertex;
      if (take(target, x, source.points[end], [&] { return source.point_name(end); }))
        target.vertex = vertex;
    }
    if (s == loose.given.source && (ends[0] == loose.given.index || ends[1] == loose.given.index))
      return;
    const Point<2> foot = nearest_on(source, segment, ends, x);
    if (foot == source.points[ends[0]] || foot == source.points[ends[1]]) return;
    take(loose.curve, x, foot, [&] { return source.segment_name(segment); });
  }

  Point<2> nearest_on(const CurveSource& source, std::int64_t segment,
                      const std::array<std::int64_t, 2>& ends, const Point<2>& x) const {
    if (source.kind != Kind::smooth)
      return nearest_on_segment(source.points[ends[0]], source.points[ends[1]], x);
    const double t = parameter_beside(source.evaluate, source.parameters[segment],
                                      source.parameters[segment + 1], x);
    Point<2> there;
    source.evaluate(1, &t, &there);
    return there;
  }

  template <class Name>
  bool take(Target& target, const Point<2>& x, const Point<2>& position, const Name& name) const {
    const double to = distance<2>(x, position);
    if (to > reach_ || to >= target.distance) return false;
    target = {to, position, {}, name()};
    return true;
  }

  // Returns whether join_sources() joins the point to a vertex as it is.
  bool is_joined(const LoosePoint& loose) const {
    const bool is_end =
        loose.given.source != kFixedNodes && sources_[loose.given.source].kind != Kind::graph;
    return std::min(loose.vertex.distance, loose.loose_vertex.distance) <=
           (is_end ? kSameCurveEnd : kSamePoint) * size_;
  }

  void move_points(Onto onto) {
    for (LoosePoint& loose : loose_) {
      const Target& target = onto == Onto::vertex  ? loose.vertex
                             : onto == Onto::curve ? loose.curve
                                                   : loose.loose_vertex;
      const bool is_on_it = onto == Onto::curve && target.distance <= kSamePoint * size_;
      if (target.distance == HUGE_VAL || is_on_it || is_joined(loose) || collapses(loose, target) ||
          held_.contains(loose.given))
        continue;
      Point<2>& x = position_of(loose.given);
      moved_.try_emplace(loose.given, Move{x, ""}).first->second.onto = target.name;
      x = target.position;
      if (onto != Onto::curve) join(loose.given, target.vertex);
    }
  }

  void join(const SourcePoint& point, const SourcePoint& vertex) {
    held_.insert(vertex);
    if (point.source == kFixedNodes || sources_[point.source].kind != Kind::graph) return;
    CurveSource& source = sources_[point.source];
    source.snapped.resize(source.points.size(), 0);
    source.snapped[point.index] = 1;
  }

  // Returns whether the segment of the point would become too short.
  bool collapses(const LoosePoint& loose, const Target& target) {
    if (!loose.neighbour) return false;
    return distance<2>(position_of({loose.given.source, *loose.neighbour}), target.position) <=
           2 * reach_;
  }

  std::vector<CurveSource>& sources_;
  std::vector<FixedNode<2>>& fixed_nodes_;
  double size_, reach_;
  std::vector<LoosePoint> loose_;
  std::set<SourcePoint> is_loose_;
  std::set<SourcePoint> held_;  // points that others were moved onto
  std::map<SourcePoint, Move> moved_;
};

}  // namespace

std::optional<Warning> snap_loose_points(std::vector<CurveSource>& sources,
                                         std::vector<FixedNode<2>>& fixed_nodes,
                                         std::optional<double> reach) {
  if (reach == 0.0 ||
      std::ranges::all_of(sources, [](const auto& source) { return source.points.empty(); }))
    return std::nullopt;
  const double size = domain_size(sources);
  return Snapping(sources, fixed_nodes, size, reach.value_or(kSnap * size)).run();
}

}  // namespace pnpbs
