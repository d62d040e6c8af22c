// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_crossings.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "domain/plane/sampling.hpp"
#include "geometry/plane/segments.hpp"
#include "predicates/plane.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// Returns whether two segments meet in one point. Segments on one line do not.
bool meet(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const int side_c = orientation(a, b, c), side_d = orientation(a, b, d);
  if (side_c * side_d > 0 || (side_c == 0 && side_d == 0)) return false;
  return orientation(c, d, a) * orientation(c, d, b) <= 0;
}

// A chord of a curve, which approaches the curve where another one crosses it.
class Chord {
 public:
  Chord(const CurveSource& source, const GraphEdge& edge, const Point<2>& a, const Point<2>& b)
      : source_(source), t_begin_(edge.t_begin), t_end_(edge.t_end), a_(a), b_(b) {}

  const Point<2>& a() const { return a_; }
  const Point<2>& b() const { return b_; }

  // Shortens the chord of a smooth curve to a part of it around the point of the curve beside x.
  // Parts of straight segments have the same direction, so these stay.
  void shorten_around(const Point<2>& x) {
    if (source_.kind != CurveSource::Kind::smooth) return;
    constexpr double kPart = 1.0 / 16;  // half of the length of the part [chord]
    const double t = parameter_beside(source_.evaluate, t_begin_, t_end_, x);
    const double half = kPart * (t_end_ - t_begin_);
    const auto [low, high] = std::minmax(t_begin_, t_end_);
    t_begin_ = std::clamp(t - half, low, high);
    t_end_ = std::clamp(t + half, low, high);
    a_ = at(t_begin_);
    b_ = at(t_end_);
  }

 private:
  Point<2> at(double t) const {
    Point<2> x;
    source_.evaluate(1, &t, &x);
    return x;
  }

  const CurveSource& source_;
  double t_begin_, t_end_;
  Point<2> a_, b_;
};

}  // namespace

std::vector<std::array<std::int32_t, 2>> crossing_edges(const DomainGraph& graph,
                                                        const std::vector<Point<2>>& points) {
  std::vector<Box<2>> boxes;
  for (const VertexPair& ends : graph.ends) {
    boxes.push_back(empty_box<2>());
    for (const std::int32_t end : ends) include(boxes.back(), points[index(end)]);
  }
  const BoxTree<2> tree(boxes);
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(boxes.size()); ++e)
    tree.for_meeting(boxes[index(e)], [&](std::int32_t f) {
      if (f <= e) return;
      const auto& [a, b] = graph.ends[index(e)];
      const auto& [c, d] = graph.ends[index(f)];
      if (a == c || a == d || b == c || b == d) return;
      if (meet(points[index(a)], points[index(b)], points[index(c)], points[index(d)]))
        pairs.push_back({e, f});
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Point<2> meeting_point(const std::vector<CurveSource>& sources, const DomainGraph& graph,
                       const std::vector<Point<2>>& points, std::int32_t edge, std::int32_t other) {
  const auto chord_of = [&](std::int32_t e) {
    const GraphEdge& of = graph.edges[index(e)];
    const auto& [a, b] = graph.ends[index(e)];
    return Chord(sources[index(of.source)], of, points[index(a)], points[index(b)]);
  };
  Chord one = chord_of(edge), two = chord_of(other);
  Point<2> x = crossing_point(one.a(), one.b(), two.a(), two.b());
  // Each round makes the distance of the chords from the curves 64 times smaller.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    one.shorten_around(x);
    two.shorten_around(x);
    x = crossing_point(one.a(), one.b(), two.a(), two.b());
  }
  return x;
}

}  // namespace pnpbs
