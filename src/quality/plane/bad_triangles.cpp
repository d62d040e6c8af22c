// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/bad_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "method/constants.hpp"
#include "neighbors/rings.hpp"
#include "quality/sweep_guard.hpp"

namespace pnpbs {

namespace {

// Returns a quality that implies a triangle_shape() of at least `shape`. Among the triangles with
// the same smallest angle an isosceles one has the largest quality.
double quality_that_suffices(double shape) {
  const double angle = std::asin(std::min(1.0, shape / method::kAngleWeight));
  const double sine = std::sin(0.25 * (M_PI - angle));
  return std::max(shape, 8 * std::sin(0.5 * angle) * sine * sine);
}

// Directions of the trial positions.
constexpr double kDiagonal = 0.70710678118654752;
constexpr std::array<Point<2>, 8> kDirections{{{1, 0},
                                               {kDiagonal, kDiagonal},
                                               {0, 1},
                                               {-kDiagonal, kDiagonal},
                                               {-1, 0},
                                               {-kDiagonal, -kDiagonal},
                                               {0, -1},
                                               {kDiagonal, -kDiagonal}}};

}  // namespace

double triangle_shape(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double ab = distance<2>(a, b), bc = distance<2>(b, c), ca = distance<2>(c, a);
  const double product = ab * bc * ca;
  if (product == 0) return 0;
  const double sine = twice_area * std::min({ab, bc, ca}) / product;
  const double quality = 4 * twice_area * std::fabs(twice_area) / (product * (ab + bc + ca));
  return std::min(quality, method::kAngleWeight * sine);
}

TriangleMeasure measure_by_shape(double bad_below) {
  return {triangle_shape, bad_below, quality_that_suffices(bad_below)};
}

BadTriangleRepair::BadTriangleRepair(Nodes<2>& nodes, const DelaunayStars& stars,
                                     const NearEdges& near_edges, const SizedTree<2>& map,
                                     TriangleMeasure measure)
    : nodes_(nodes),
      stars_(stars),
      near_edges_(near_edges),
      map_(map),
      measure_(std::move(measure)) {
  for (const std::int32_t i :
       nodes_with_doubtful_triangles(nodes, stars, measure_.sufficient_quality))
    if (nodes.moves(i) && stars.closed(i)) candidates_.push_back({i});
}

// Computes the values of the triangles around node i with the node at x.
void BadTriangleRepair::find_values(std::int64_t i, const Point<2>& x,
                                    std::vector<double>& values) const {
  values.clear();
  stars_.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    values.push_back(measure_.value_of(x, nodes_.position(others[0]), nodes_.position(others[1])));
  });
}

// Returns whether a triangle gets worse that is or becomes bad.
bool BadTriangleRepair::makes_bad_worse(const std::vector<double>& before,
                                        const std::vector<double>& after) const {
  for (std::size_t t = 0; t < after.size(); ++t)
    if (after[t] < std::min(before[t], measure_.bad_below)) return true;
  return false;
}

// Returns x, moved off the boundary edges as far as necessary, or the current position of node i if
// that fails.
Point<2> BadTriangleRepair::allowed_place(std::int64_t i, const Point<2>& x) const {
  if (!near_edges_.any(i)) return x;
  const ClearPosition<2> kept =
      clear_position(map_, near_edges_.edges_of(i), nodes_.position(i), x, nodes_.d(i));
  return kept.clear ? nodes_.cell.rounded(kept.position) : nodes_.position(i);
}

// Searches for the position of the candidate that improves its worst triangle most, at ever smaller
// distances.
void BadTriangleRepair::find_better_position(Candidate& candidate) const {
  const std::int64_t i = candidate.node;
  const Point<2> x = nodes_.position(i);
  std::vector<double> before, after;
  find_values(i, x, before);
  candidate.worst = *std::min_element(before.begin(), before.end());
  candidate.wants = false;
  if (candidate.worst >= measure_.bad_below) return;
  double best = candidate.worst;
  for (double way = method::kRepairFirstWay; way >= method::kRepairLastWay; way *= 0.5)
    for (const Point<2>& direction : kDirections) {
      const double d = nodes_.d(i);
      const Point<2> place = allowed_place(
          i, nodes_.position_after(i, {way * d * direction[0], way * d * direction[1]}));
      find_values(i, place, after);
      const double worst = *std::min_element(after.begin(), after.end());
      if (worst <= best || makes_bad_worse(before, after)) continue;
      best = worst;
      candidate.goal = place;
      candidate.wants = true;
    }
}

const BadTriangleRepair::Candidate* BadTriangleRepair::candidate_of(std::int64_t i) const {
  const auto found = std::lower_bound(
      candidates_.begin(), candidates_.end(), i,
      [](const Candidate& candidate, std::int64_t node) { return candidate.node < node; });
  return found != candidates_.end() && found->node == i ? &*found : nullptr;
}

// Returns whether the candidate wins against its neighbours, which would change the same triangles.
bool BadTriangleRepair::comes_first(const Candidate& candidate) const {
  return for_rings(stars_, candidate.node, 1, [&](std::int64_t j, int) {
    const Candidate* other = candidate_of(j);
    if (!other || !other->wants) return true;
    return other->worst > candidate.worst ||
           (other->worst == candidate.worst && nodes_.id(j) > nodes_.id(candidate.node));
  });
}

std::int64_t BadTriangleRepair::round() {
  for_each("pnpbs::BadTriangleRepair::find_better_position",
           static_cast<std::int64_t>(candidates_.size()),
           [&](std::int64_t c) { find_better_position(candidates_[static_cast<std::size_t>(c)]); });
  std::int64_t moved = 0;
  for (const Candidate& candidate : candidates_) {
    if (!candidate.wants || !comes_first(candidate)) continue;
    nodes_.set_position(candidate.node, candidate.goal);
    moved += nodes_.owned(candidate.node);
  }
  nodes_.moved();
  return moved;
}

}  // namespace pnpbs
