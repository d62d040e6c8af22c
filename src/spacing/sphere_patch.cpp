// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_patch.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "predicates/space.hpp"
#include "spacing/patch_weights.hpp"

namespace pnpbs {

namespace {

constexpr Point<3> kCentre{0, 0, 0};

template <std::size_t N>
struct SphereCorners {
  std::array<Point<3>, N> x;
  std::array<double, N> value;
  std::array<std::int64_t, N> id;

  SphereCorners(const Patch<2, 3>& patch, const std::array<std::int32_t, N>& row) {
    for (std::size_t k = 0; k < N; ++k) {
      const PatchNode<3>& node = patch.nodes[static_cast<std::size_t>(row[k])];
      x[k] = node.x;
      value[k] = node.value;
      id[k] = node.id;
    }
  }

  // Clamps an interpolated value to the range of the corners' values, which rounding may leave.
  double within(double rounded) const {
    const auto [min, max] = std::minmax_element(value.begin(), value.end());
    return std::clamp(rounded, *min, *max);
  }

  // Returns a box around the part of the sphere above the simplex. A point of the simplex with
  // barycentric coordinates l_i has the squared norm R^2 - sum of l_i l_j |x_i - x_j|^2 over pairs,
  // and the sum of l_i l_j is at most (1 - 1 / N) / 2.
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
BoxTree<3> tree_over(const Patch<2, 3>& patch, const std::vector<std::array<std::int32_t, N>>& rows,
                     double radius) {
  std::vector<Box<3>> boxes;
  boxes.reserve(rows.size());
  for (const auto& row : rows) boxes.push_back(SphereCorners<N>(patch, row).box(radius));
  return BoxTree<3>(std::move(boxes));
}

// Returns six times the signed volume of the tetrahedron with the centre of the sphere. Differences
// are small and keep rounding errors small.
double volume_below(const std::array<Point<3>, 3>& x) {
  return dot(x[0], cross(difference(x[1], x[0]), difference(x[2], x[0])));
}

// Returns the exact orientation, so that adjacent triangles leave no gap between them.
int turn_below(const std::array<Point<3>, 3>& x) { return orientation(x[0], x[1], x[2], kCentre); }

std::array<Point<3>, 3> with(std::array<Point<3>, 3> corners, std::size_t k, const Point<3>& x) {
  corners[k] = x;
  return corners;
}

// Returns the unnormalised barycentric coordinates of the ray through x.
std::array<double, 3> shares_below(const std::array<Point<3>, 3>& corners, const Point<3>& x) {
  std::array<double, 3> shares;
  for (std::size_t k = 0; k < 3; ++k) shares[k] = volume_below(with(corners, k, x));
  return shares;
}

// Returns barycentric coordinates for extrapolation outside of the triangle. Far from the triangle
// rays meet its plane at large distances, and at 90 degrees they do not meet it. Where a ray is
// longer than the radius, the field is therefore extended in space instead, with the mean of the
// corners at the centre of the sphere, which is bounded.
std::array<double, 3> shares_beyond(const std::array<Point<3>, 3>& corners, const Point<3>& x) {
  std::array<double, 3> shares = shares_below(corners, x);
  const double whole = volume_below(corners);
  const double missing = whole - (shares[0] + shares[1] + shares[2]);
  if (missing * whole > 0)
    for (double& share : shares) share += missing / 3;
  return shares;
}

// Returns whether x lies on a ray from the centre through the triangle.
bool is_above(const std::array<Point<3>, 3>& corners, const Point<3>& x) {
  const int whole = turn_below(corners);
  for (std::size_t k = 0; k < 3; ++k)
    if (turn_below(with(corners, k, x)) * whole < 0) return false;
  return true;
}

// Returns the position on the chord from a to b, from 0 to 1, that is below the point of the arc
// nearest to x.
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

}  // namespace

SpherePatch::SpherePatch(Patch<2, 3> patch, double radius)
    : patch_(std::move(patch)),
      radius_(radius),
      by_triangle_(tree_over(patch_, patch_.simplices, radius)),
      by_side_(tree_over(patch_, patch_.border, radius)) {}

void SpherePatch::interpolate(const Point<3>& x, PatchAnswer<2>& best) const {
  by_triangle_.for_holding(x, [&](std::int32_t t) {
    const SphereCorners<3> corners(patch_, patch_.simplices[static_cast<std::size_t>(t)]);
    PatchAnswer<2> answer{0, corners.id, 0, -1, t};
    if (!(answer < best) || !is_above(corners.x, x)) return;
    double sum = 0, all = 0;
    const std::array<double, 3> shares = shares_below(corners.x, x);
    for (std::size_t k = 0; k < 3; ++k) {
      sum += shares[k] * corners.value[k];
      all += shares[k];
    }
    answer.value = corners.within(all != 0 ? sum / all : corners.value[0]);
    best = answer;
  });
}

// The gap is at least the distance to the side's box, so skipping boxes that are farther than the
// best answer does not change the result.
void SpherePatch::extend(const Point<3>& x, PatchAnswer<2>& best) const {
  by_side_.for_near(
      x, [&] { return best.gap; },
      [&](std::int32_t s) {
        const SphereCorners<2> ends(patch_, patch_.border[static_cast<std::size_t>(s)]);
        const double along = nearest_on_arc(ends.x, x);
        const Point<3> foot =
            unit_vector(shifted(ends.x[0], along, difference(ends.x[1], ends.x[0])));
        PatchAnswer<2> answer{0, {ends.id[0], ends.id[1], 0}, 0, -1, -1 - s};
        answer.gap = std::max(
            squared_distance<3>(x, {radius_ * foot[0], radius_ * foot[1], radius_ * foot[2]}),
            squared_gap_to(ends.box(radius_), x));
        answer.value = ends.within(std::lerp(ends.value[0], ends.value[1], along));
        if (answer < best) best = answer;
      });
}

PatchWeights<2> SpherePatch::weights(const Point<3>& x, std::int32_t row) const {
  return weights_in(
      patch_, x, row,
      [&](const std::array<std::int32_t, 3>& triangle) {
        const SphereCorners<3> corners(patch_, triangle);
        return row >= 0 ? shares_below(corners.x, x) : shares_beyond(corners.x, x);
      },
      [&](const std::array<std::int32_t, 2>& side) {
        return std::array<double, 1>{nearest_on_arc(SphereCorners<2>(patch_, side).x, x)};
      });
}

}  // namespace pnpbs
