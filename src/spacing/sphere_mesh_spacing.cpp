// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_mesh_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "base/started_execution.hpp"
#include "predicates/space.hpp"
#include "spacing/simplex_slope.hpp"

namespace pnpbs {

namespace {

constexpr Point<3> kCentre{0, 0, 0};

template <std::size_t N>
struct SphereCorners {
  std::array<Point<3>, N> x;
  std::array<double, N> value;

  SphereCorners(const Patch<3>& patch, const std::array<std::int32_t, N>& row) {
    for (std::size_t k = 0; k < N; ++k) {
      const PatchNode<3>& node = patch.nodes[static_cast<std::size_t>(row[k])];
      x[k] = node.x;
      value[k] = node.value;
    }
  }

  // Rounding must not take the value beyond those of the corners.
  double within(double rounded) const {
    const auto [min, max] = std::minmax_element(value.begin(), value.end());
    return std::clamp(rounded, *min, *max);
  }

  // Around what lies on the sphere above the simplex. A point of it with parts l_i of the corners
  // has the square R^2 - sum of l_i l_j |x_i - x_j|^2 over pairs; the sum of l_i l_j is at most
  // (1 - 1 / N) / 2.
  Box<3> box(double radius) const {
    Box<3> box{x[0], x[0]};
    double square = 0;
    for (const Point<3>& a : x) {
      box = joined(box, {a, a});
      for (const Point<3>& b : x) square = std::max(square, squared_distance<3>(a, b));
    }
    const double least = radius * radius - square * static_cast<double>(N - 1) / (2 * N);
    constexpr double kRounding = 1e-12;
    const double above = (1 + kRounding) * radius - std::sqrt(std::max(0.0, least));
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] -= above;
      box.high[k] += above;
    }
    return box;
  }
};

template <std::size_t N>
BoxTree<3> tree_over(const Patch<3>& patch, const std::vector<std::array<std::int32_t, N>>& rows,
                     double radius) {
  std::vector<Box<3>> boxes;
  boxes.reserve(rows.size());
  for (const auto& row : rows) boxes.push_back(SphereCorners<N>(patch, row).box(radius));
  return BoxTree<3>(std::move(boxes));
}

// Six times the volume of the tetrahedron with the centre, with its sign: by differences, which
// are small.
double volume_below(const std::array<Point<3>, 3>& x) {
  return dot(x[0], cross(difference(x[1], x[0]), difference(x[2], x[0])));
}

// Exact, so that triangles with a common side leave no gap between them.
int turn_below(const std::array<Point<3>, 3>& x) { return orientation(x[0], x[1], x[2], kCentre); }

std::array<Point<3>, 3> with(std::array<Point<3>, 3> corners, std::size_t k, const Point<3>& x) {
  corners[k] = x;
  return corners;
}

// Is x on a ray from the centre through the triangle?
bool is_above(const std::array<Point<3>, 3>& corners, const Point<3>& x) {
  const int whole = turn_below(corners);
  for (std::size_t k = 0; k < 3; ++k)
    if (turn_below(with(corners, k, x)) * whole < 0) return false;
  return true;
}

// The part of the straight way from a to b after which the ray through the nearest point of the
// arc between them meets it.
double nearest_on_arc(const std::array<Point<3>, 2>& arc, const Point<3>& x) {
  const auto& [a, b] = arc;
  const Point<3> normal = cross(a, difference(b, a));
  const double square = dot(normal, normal);
  if (square > 0) {
    const Point<3> foot = shifted(x, -dot(x, normal) / square, normal);
    const double from_a = dot(cross(a, difference(foot, a)), normal),
                 from_b = dot(cross(foot, difference(b, foot)), normal);
    if (from_a >= 0 && from_b >= 0 && from_a + from_b > 0) return from_a / (from_a + from_b);
  }
  return squared_distance<3>(a, x) <= squared_distance<3>(b, x) ? 0 : 1;
}

std::vector<std::array<std::int32_t, 2>> sides_of_one(
    const std::vector<std::array<std::int32_t, 3>>& triangles) {
  std::vector<std::array<std::int32_t, 2>> sides, open;
  for (const auto& [a, b, c] : triangles) sides.insert(sides.end(), {{a, b}, {a, c}, {b, c}});
  std::sort(sides.begin(), sides.end());
  for (auto side = sides.begin(); side != sides.end();) {
    const auto next = std::find_if(side, sides.end(), [&](const auto& s) { return s != *side; });
    if (next - side == 1) open.push_back(*side);
    side = next;
  }
  return open;
}

}  // namespace

SphereMeshSpacing::SphereMeshSpacing(const SphereField& field, double radius)
    : radius_(radius), triangles_(field.elements) {
  for (std::size_t i = 0; i < field.points.size(); ++i)
    nodes_.nodes.push_back({field.points[i], static_cast<std::int64_t>(i), field.values[i]});
  // The same one twice is one.
  for (auto& triangle : triangles_) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles_.begin(), triangles_.end());
  triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
  border_ = sides_of_one(triangles_);
  by_triangle_ = tree_over(nodes_, triangles_, radius);
  by_side_ = tree_over(nodes_, border_, radius);
}

// Of several triangles, the one with the least numbers of nodes.
void SphereMeshSpacing::interpolate(const Point<3>& x, Answer& best) const {
  by_triangle_.for_holding(x, [&](std::int32_t t) {
    const auto& row = triangles_[static_cast<std::size_t>(t)];
    const SphereCorners<3> corners(nodes_, row);
    Answer answer{0, {row[0], row[1], row[2]}, 0, -1, t};
    if (!(answer < best) || !is_above(corners.x, x)) return;
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = volume_below(with(corners.x, k, x));
      sum += share * corners.value[k];
      all += share;
    }
    answer.value = corners.within(all != 0 ? sum / all : corners.value[0]);
    best = answer;
  });
}

// The gap is never less than that to the side's box, so that boxes that are farther than the best
// answer can be passed over without changing it.
void SphereMeshSpacing::extend(const Point<3>& x, Answer& best) const {
  by_side_.for_near(
      x, [&] { return best.gap; },
      [&](std::int32_t s) {
        const auto& row = border_[static_cast<std::size_t>(s)];
        const SphereCorners<2> ends(nodes_, row);
        const double along = nearest_on_arc(ends.x, x);
        const Point<3> foot =
            unit_vector(shifted(ends.x[0], along, difference(ends.x[1], ends.x[0])));
        Answer answer{0, {row[0], row[1], 0}, 0, -1, -1 - s};
        answer.gap = std::max(
            squared_distance<3>(x, {radius_ * foot[0], radius_ * foot[1], radius_ * foot[2]}),
            squared_gap_to(ends.box(radius_), x));
        answer.value = ends.within(std::lerp(ends.value[0], ends.value[1], along));
        if (answer < best) best = answer;
      });
}

SphereMeshSpacing::Answer SphereMeshSpacing::answer_at(const Point<3>& x) const {
  Answer answer;
  interpolate(x, answer);
  if (!answer.found()) extend(x, answer);
  return answer;
}

void SphereMeshSpacing::evaluate(std::int64_t n, const Point<3>* x, double* d) const {
  for_each_if_started("pnpbs::SphereMeshSpacing::evaluate", n,
                      [=, this](std::int64_t i) { d[i] = answer_at(x[i]).value; });
}

std::optional<GivenExtent<3>> SphereMeshSpacing::extent() const {
  return GivenExtent<3>{"background mesh", "d is that of the mesh's nearest point", {}};
}

void SphereMeshSpacing::distance_to_extent(std::int64_t n, const Point<3>* x,
                                           double* distances) const {
  for_each_if_started("pnpbs::SphereMeshSpacing::distance_to_extent", n, [=, this](std::int64_t i) {
    const double straight = std::sqrt(answer_at(x[i]).gap) / (2 * radius_);
    distances[i] = 2 * radius_ * std::asin(std::min(1.0, straight));
  });
}

KnownValues<3> SphereMeshSpacing::known_values() const {
  KnownValues<3> known;
  std::vector<bool> used(nodes_.nodes.size(), false);
  for (const auto& triangle : triangles_) {
    for (const std::int32_t i : triangle) used[static_cast<std::size_t>(i)] = true;
    known.slopes.push_back(slope_of(nodes_, triangle));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) known.values.push_back({nodes_.nodes[i].x, nodes_.nodes[i].value});
  return known;
}

}  // namespace pnpbs
