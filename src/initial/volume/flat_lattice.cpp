// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/flat_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/space_vectors.hpp"
#include "domain/volume/triangles.hpp"
#include "predicates/plane.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

constexpr double kParallel = 1e-4;  // radians

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Feature edges that follow each other in one direction.
struct StraightRun {
  Point<3> begin, end;
  double length() const { return distance<3>(begin, end); }
  Point<3> direction() const { return unit_vector(difference(end, begin)); }
};

std::vector<StraightRun> straight_runs(const Surface& surface, std::int32_t patch) {
  std::vector<StraightRun> runs;
  const auto position = [&](std::int32_t node) {
    return surface.mesh().nodes[index(node)].position;
  };
  for (const FeatureCurve& curve : surface.features().curves) {
    bool goes_on = false;
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      const std::vector<std::int32_t>& facets = curve.facets[e];
      if (std::none_of(facets.begin(), facets.end(),
                       [&](std::int32_t f) { return surface.patch(f) == patch; }))
        break;  // nor has any other edge of the curve
      const StraightRun edge{position(curve.nodes[e]), position(curve.nodes[e + 1])};
      if (goes_on && distance<3>(edge.direction(), runs.back().direction()) < kParallel)
        runs.back().end = edge.end;
      else
        runs.push_back(edge);
      goes_on = true;
    }
  }
  return runs;
}

// The patch's facets by two coordinates in its plane.
class FlatPatch {
 public:
  FlatPatch(const Surface& surface, const std::vector<std::int32_t>& facets, const Point<3>& origin,
            const Point<3>& along, const Point<3>& across)
      : surface_(surface), facets_(facets), origin_(origin), along_(along), across_(across) {
    std::vector<Box<2>> boxes;
    for (const std::int32_t f : facets) {
      const std::array<Point<2>, 3> x = corners(f);
      boxes.push_back(joined(joined(Box<2>{x[0], x[0]}, {x[1], x[1]}), {x[2], x[2]}));
      bounds_ = boxes.size() == 1 ? boxes[0] : joined(bounds_, boxes.back());
    }
    boxes_ = BoxTree<2>(std::move(boxes));
  }

  const Box<2>& bounds() const { return bounds_; }

  Point<2> coordinates(const Point<3>& x) const {
    const Point<3> way = difference(x, origin_);
    return {dot(way, along_), dot(way, across_)};
  }

  // Facet -1: beyond the patch. Of facets that meet there, the first.
  SurfacePoint at(const Point<2>& x) const {
    std::int32_t facet = std::numeric_limits<std::int32_t>::max();
    boxes_.for_holding(x, [&](std::int32_t n) {
      const std::int32_t f = facets_[index(n)];
      if (f < facet && holds(f, x)) facet = f;
    });
    if (facet == std::numeric_limits<std::int32_t>::max()) return {-1, {}};
    const Point<3> in_plane = shifted(shifted(origin_, x[0], along_), x[1], across_);
    return {facet, nearest_on(surface_.corners(facet), in_plane)};
  }

 private:
  std::array<Point<2>, 3> corners(std::int32_t f) const {
    const auto [a, b, c] = surface_.corners(f);
    return {coordinates(a), coordinates(b), coordinates(c)};
  }

  bool holds(std::int32_t f, const Point<2>& x) const {
    const auto [a, b, c] = corners(f);
    return orientation(a, b, x) >= 0 && orientation(b, c, x) >= 0 && orientation(c, a, x) >= 0;
  }

  const Surface& surface_;
  const std::vector<std::int32_t>& facets_;
  Point<3> origin_, along_, across_;
  Box<2> bounds_{};
  BoxTree<2> boxes_;
};

// How far the farthest of the long edges parallel to the first row is from it; 0 if there is none.
double distance_to_parallel(const FlatPatch& flat, const std::vector<StraightRun>& runs,
                            const StraightRun& base) {
  double farthest = 0;
  for (const StraightRun& run : runs) {
    const Point<2> a = flat.coordinates(run.begin), b = flat.coordinates(run.end);
    const bool parallel = std::fabs(b[1] - a[1]) < kParallel * run.length();
    if (!parallel || run.length() < 0.5 * base.length()) continue;
    if (std::fabs(a[1]) > std::fabs(farthest)) farthest = a[1];
  }
  return std::fabs(farthest);
}

}  // namespace

std::vector<SurfacePoint> flat_lattice(const Surface& surface, std::int32_t patch,
                                       const std::vector<std::int32_t>& facets, double d,
                                       double clearance) {
  const std::vector<StraightRun> runs = straight_runs(surface, patch);
  if (runs.empty() || facets.empty()) return {};
  const StraightRun& base = *std::max_element(
      runs.begin(), runs.end(),
      [](const StraightRun& a, const StraightRun& b) { return a.length() < b.length(); });
  const Point<3> along = base.direction(), across = cross(surface.normal(facets[0]), along);
  const FlatPatch flat(surface, facets, base.begin, along, across);

  const auto fitted = [](double step, double extent) {
    const double steps = std::round(extent / step);
    return steps >= 1 ? extent / steps : step;
  };
  const double step = fitted(d, base.length());
  const double row = fitted(std::sqrt(0.75) * d, distance_to_parallel(flat, runs, base));
  // Half a step beside an edge is far enough, though steps may be shorter than d.
  const double free = (1 - 1e-9) * clearance * std::min(step, d);
  std::vector<SurfacePoint> nodes;
  const auto first_row = static_cast<std::int64_t>(std::ceil(flat.bounds().low[1] / row));
  for (std::int64_t r = first_row; static_cast<double>(r) * row <= flat.bounds().high[1]; ++r) {
    const double shift = r % 2 != 0 ? 0.5 * step : 0;
    auto column = static_cast<std::int64_t>(std::ceil((flat.bounds().low[0] - shift) / step));
    for (;; ++column) {
      const Point<2> x{shift + step * static_cast<double>(column), row * static_cast<double>(r)};
      if (x[0] > flat.bounds().high[0]) break;
      const SurfacePoint at = flat.at(x);
      if (at.facet >= 0 && surface.feature_clearance(at, free) >= free) nodes.push_back(at);
    }
  }
  return nodes;
}

}  // namespace pnpbs
