// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/flat_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangles.hpp"
#include "predicates/plane.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

constexpr double kParallel = 1e-4;   // radians
constexpr double kRounding = 1e-12;  // of places, in units of a patch

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
      for (const Point<3>& corner : surface.corners(f))
        height_ = std::max(height_, distance<3>(corner, in_plane(coordinates(corner))));
    }
    boxes_ = BoxTree<2>(std::move(boxes));
  }

  const Box<2>& bounds() const { return bounds_; }

  Point<2> coordinates(const Point<3>& x) const {
    const Point<3> way = difference(x, origin_);
    return {dot(way, along_), dot(way, across_)};
  }

  // Around all nodes whose coordinates are in such a box: a facet may lie a little off the plane.
  Box<3> box_around(const Box<2>& x) const {
    Box<3> box = empty_box<3>();
    for (const double u : {x.low[0], x.high[0]})
      for (const double v : {x.low[1], x.high[1]}) include(box, in_plane({u, v}));
    const double size = bounds_.high[0] - bounds_.low[0] + bounds_.high[1] - bounds_.low[1];
    return widened(box, 2 * height_ + kRounding * size);
  }

  // Facet -1: beyond the patch. Of facets that meet there, the first.
  SurfacePoint at(const Point<2>& x) const {
    std::int32_t facet = std::numeric_limits<std::int32_t>::max();
    boxes_.for_holding(x, [&](std::int32_t n) {
      const std::int32_t f = facets_[index(n)];
      if (f < facet && holds(f, x)) facet = f;
    });
    if (facet == std::numeric_limits<std::int32_t>::max()) return {-1, {}};
    return {facet, nearest_on(surface_.corners(facet), in_plane(x))};
  }

 private:
  Point<3> in_plane(const Point<2>& x) const {
    return shifted(shifted(origin_, x[0], along_), x[1], across_);
  }

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
  double height_ = 0;  // of the corner farthest from the plane
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

// Rows and columns from the first to before the last.
struct Block {
  std::int64_t first_row, last_row, first_column, last_column;

  bool empty() const { return first_row >= last_row || first_column >= last_column; }
  std::int64_t rows() const { return last_row - first_row; }
  std::int64_t columns() const { return last_column - first_column; }
};

// Rows `row` apart, of nodes `step` apart, every other one shifted by half of that.
class Rows {
 public:
  Rows(const FlatPatch& flat, double step, double row) : flat_(flat), step_(step), row_(row) {}

  Block whole() const {
    const Box<2>& bounds = flat_.bounds();
    return {whole_number(std::ceil(bounds.low[1] / row_)),
            whole_number(std::floor(bounds.high[1] / row_)) + 1,
            whole_number(std::ceil(bounds.low[0] / step_ - 0.5)),
            whole_number(std::floor(bounds.high[0] / step_)) + 1};
  }

  Point<2> place(std::int64_t r, std::int64_t column) const {
    const double shift = r % 2 != 0 ? 0.5 * step_ : 0;
    return {shift + step_ * static_cast<double>(column), row_ * static_cast<double>(r)};
  }

  // Calls visit(place) for those that may be in cells of this rank: halves a block until it is
  // small or meets none.
  template <class Visit>
  void for_places(const Block& block, const RankCells& cells, const Visit& visit) const {
    constexpr std::int64_t kSmall = 8;
    if (block.empty() || !cells.meet(flat_.box_around(box_of(block)))) return;
    Block one = block, other = block;
    if (std::max(block.rows(), block.columns()) <= kSmall) {
      for (std::int64_t r = block.first_row; r < block.last_row; ++r)
        for (std::int64_t c = block.first_column; c < block.last_column; ++c) visit(place(r, c));
      return;
    }
    if (block.rows() > block.columns())
      one.last_row = other.first_row = block.first_row + block.rows() / 2;
    else
      one.last_column = other.first_column = block.first_column + block.columns() / 2;
    for_places(one, cells, visit);
    for_places(other, cells, visit);
  }

 private:
  static std::int64_t whole_number(double t) { return static_cast<std::int64_t>(t); }

  Box<2> box_of(const Block& block) const {
    const auto first_column = static_cast<double>(block.first_column),
               last_column = static_cast<double>(block.last_column);
    return {{step_ * first_column, row_ * static_cast<double>(block.first_row)},
            {step_ * (last_column - 0.5), row_ * static_cast<double>(block.last_row - 1)}};
  }

  const FlatPatch& flat_;
  double step_, row_;
};

}  // namespace

std::vector<SurfacePoint> flat_lattice(const Surface& surface, std::int32_t patch,
                                       const std::vector<std::int32_t>& facets, double d,
                                       double clearance, const RankCells& cells) {
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
  const Rows rows(flat, step, row);
  rows.for_places(rows.whole(), cells, [&](const Point<2>& x) {
    const SurfacePoint at = flat.at(x);
    if (at.facet >= 0 && cells.hold(at.position) && surface.feature_clearance(at, free) >= free)
      nodes.push_back(at);
  });
  return nodes;
}

}  // namespace pnpbs
