// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/smooth_contacts.hpp"

#include <algorithm>
#include <utility>

#include "base/limits.hpp"
#include "domain/plane/sampling.hpp"
#include "geometry/plane/point_tree.hpp"

namespace pnpbs {

namespace {

using Kind = CurveSource::Kind;

struct Sample {
  double parameter;
  Point<2> point;
};

// New samples of one curve, each after the old one with this index.
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

struct Attachable {
  Point<2> point;
  double same;  // distance that counts as the same place
};

std::vector<Attachable> attachables(const std::vector<CurveSource>& sources,
                                    const std::vector<FixedNode<2>>& fixed_nodes, double size) {
  std::vector<Attachable> result;
  for (const CurveSource& source : sources) {
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(source.points.size()); ++i) {
      const bool end = source.ends_at(i);
      if (source.kind == Kind::smooth && !end) continue;
      result.push_back({source.points[i], (end ? kSameCurveEnd : kSamePlace) * size});
    }
  }
  for (const FixedNode<2>& node : fixed_nodes) result.push_back({node.position, kSamePlace * size});
  return result;
}

// A chord keeps closer to its curve than this, in units of its length (but at kinks, where chords
// are tiny).
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

}  // namespace

void attach_to_smooth_curves(std::vector<CurveSource>& sources,
                             const std::vector<FixedNode<2>>& fixed_nodes, double size) {
  const bool any = std::any_of(sources.begin(), sources.end(), [](const CurveSource& source) {
    return source.kind == Kind::smooth;
  });
  if (!any) return;
  const std::vector<Attachable> all = attachables(sources, fixed_nodes, size);
  std::vector<Point<2>> points;
  for (const Attachable& attachable : all) points.push_back(attachable.point);
  const PointTree tree(std::move(points));
  for (CurveSource& source : sources) {
    if (source.kind == Kind::smooth) attach(source, all, tree);
  }
}

bool refine_conflicting_chords(std::vector<CurveSource>& sources, const DomainGraph& graph,
                               const std::vector<SweepConflict>& conflicts) {
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
  for (const SweepConflict& conflict : conflicts) {
    halve(conflict.edge);
    if (conflict.other >= 0) halve(conflict.other);
  }
  bool any = false;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (added[s].empty()) continue;
    insert(sources[s], added[s]);
    any = true;
  }
  return any;
}

}  // namespace pnpbs
