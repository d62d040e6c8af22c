// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/nodal_patch.hpp"

#include <algorithm>

#include "geometry/volume/triangles.hpp"
#include "predicates/plane.hpp"
#include "predicates/space.hpp"
#include "spacing/patch_weights.hpp"

namespace pnpbs {

namespace {

// The corners of a simplex or facet.
template <int Dim, std::size_t N>
struct Corners {
  std::array<Point<Dim>, N> x;
  std::array<double, N> value;
  std::array<std::int64_t, N> id;

  Corners(const std::vector<PatchNode<Dim>>& nodes, const std::array<std::int32_t, N>& row) {
    for (std::size_t k = 0; k < N; ++k) {
      const PatchNode<Dim>& node = nodes[static_cast<std::size_t>(row[k])];
      x[k] = node.x;
      value[k] = node.value;
      id[k] = node.id;
    }
  }

  Box<Dim> box() const {
    Box<Dim> box{x[0], x[0]};
    for (const Point<Dim>& corner : x) box = joined(box, {corner, corner});
    return box;
  }

  // Clamps an interpolated value to the range of the corners' values, which rounding may leave.
  double within(double rounded) const {
    const auto [min, max] = std::minmax_element(value.begin(), value.end());
    return std::clamp(rounded, *min, *max);
  }
};

template <int Dim, std::size_t N>
BoxTree<Dim> tree_of(const std::vector<PatchNode<Dim>>& nodes,
                     const std::vector<std::array<std::int32_t, N>>& rows) {
  std::vector<Box<Dim>> boxes;
  boxes.reserve(rows.size());
  for (const auto& row : rows) boxes.push_back(Corners<Dim, N>(nodes, row).box());
  return BoxTree<Dim>(std::move(boxes));
}

int side(const std::array<Point<2>, 3>& x) { return orientation(x[0], x[1], x[2]); }
int side(const std::array<Point<3>, 4>& x) { return orientation(x[0], x[1], x[2], x[3]); }

// Returns whether the closed simplex contains x: replacing any corner by x never reverses the
// orientation.
template <int Dim>
bool holds(const std::array<Point<Dim>, Dim + 1>& simplex, const Point<Dim>& x) {
  bool left = false, right = false;
  for (std::size_t k = 0; k <= Dim; ++k) {
    std::array<Point<Dim>, Dim + 1> part = simplex;
    part[k] = x;
    const int sign = side(part);
    left = left || sign > 0;
    right = right || sign < 0;
  }
  return !(left && right);
}

// Returns twice the signed area of triangle (x, a, b).
double area(const Point<2>& x, const Point<2>& a, const Point<2>& b) {
  return (a[0] - x[0]) * (b[1] - x[1]) - (a[1] - x[1]) * (b[0] - x[0]);
}

// Returns six times the signed volume of tetrahedron (x, a, b, c).
double volume(const Point<3>& x, const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Point<3> u{a[0] - x[0], a[1] - x[1], a[2] - x[2]};
  const Point<3> v{b[0] - x[0], b[1] - x[1], b[2] - x[2]};
  const Point<3> w{c[0] - x[0], c[1] - x[1], c[2] - x[2]};
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// Returns the unnormalised barycentric coordinates of x.
std::array<double, 3> shares(const std::array<Point<2>, 3>& c, const Point<2>& x) {
  return {area(x, c[1], c[2]), area(x, c[2], c[0]), area(x, c[0], c[1])};
}
std::array<double, 4> shares(const std::array<Point<3>, 4>& c, const Point<3>& x) {
  return {volume(x, c[1], c[2], c[3]), volume(x, c[0], c[3], c[2]), volume(x, c[0], c[1], c[3]),
          volume(x, c[0], c[2], c[1])};
}

// A point of an edge, and its share of the vector from the first end to the second.
struct EdgePoint {
  Point<2> x;
  std::array<double, 1> along;
};

EdgePoint nearest_point(const std::array<Point<2>, 2>& edge, const Point<2>& x) {
  const auto& [a, b] = edge;
  const double way[2] = {b[0] - a[0], b[1] - a[1]};
  const double t = std::clamp(
      ((x[0] - a[0]) * way[0] + (x[1] - a[1]) * way[1]) / (way[0] * way[0] + way[1] * way[1]), 0.0,
      1.0);
  return {{a[0] + t * way[0], a[1] + t * way[1]}, {t}};
}
TrianglePoint nearest_point(const std::array<Point<3>, 3>& triangle, const Point<3>& x) {
  return nearest_triangle_point(triangle, x);
}

}  // namespace

template <int Dim>
NodalPatch<Dim>::NodalPatch(Patch<Dim> patch)
    : patch_(std::move(patch)),
      by_simplex_(tree_of(patch_.nodes, patch_.simplices)),
      by_facet_(tree_of(patch_.nodes, patch_.border)) {}

template <int Dim>
void NodalPatch<Dim>::interpolate(const Point<Dim>& x, PatchAnswer<Dim>& best) const {
  by_simplex_.for_holding(x, [&](std::int32_t s) {
    const Corners<Dim, Dim + 1> corners(patch_.nodes,
                                        patch_.simplices[static_cast<std::size_t>(s)]);
    if (!holds<Dim>(corners.x, x)) return;
    PatchAnswer<Dim> answer{0, corners.id, 0, -1, s};
    if (!(answer < best)) return;
    double sum = 0, all = 0;
    const auto share = shares(corners.x, x);
    for (std::size_t k = 0; k <= Dim; ++k) {
      sum += share[k] * corners.value[k];
      all += share[k];
    }
    // The sum may vanish in a nearly flat simplex.
    answer.value = corners.within(all != 0 ? sum / all : corners.value[0]);
    best = answer;
  });
}

// The gap is at least the distance to the facet's box, so skipping boxes that are farther than the
// best answer does not change the result.
template <int Dim>
void NodalPatch<Dim>::extend(const Point<Dim>& x, PatchAnswer<Dim>& best) const {
  by_facet_.for_near(
      x, [&] { return best.gap; },
      [&](std::int32_t f) {
        const Corners<Dim, Dim> corners(patch_.nodes, patch_.border[static_cast<std::size_t>(f)]);
        const auto foot = nearest_point(corners.x, x);
        PatchAnswer<Dim> answer;
        answer.gap = std::max(squared_distance<Dim>(x, foot.x), squared_gap_to(corners.box(), x));
        std::copy(corners.id.begin(), corners.id.end(), answer.ids.begin());
        double value = corners.value[0];
        for (std::size_t k = 1; k < Dim; ++k)
          value += foot.along[k - 1] * (corners.value[k] - corners.value[0]);
        answer.value = corners.within(value);
        answer.row = -1 - f;
        if (answer < best) best = answer;
      });
}

template <int Dim>
PatchWeights<Dim> NodalPatch<Dim>::weights(const Point<Dim>& x, std::int32_t row) const {
  return weights_in(
      patch_, x, row,
      [&](const std::array<std::int32_t, Dim + 1>& simplex) {
        return shares(Corners<Dim, Dim + 1>(patch_.nodes, simplex).x, x);
      },
      [&](const std::array<std::int32_t, Dim>& facet) {
        return nearest_point(Corners<Dim, Dim>(patch_.nodes, facet).x, x).along;
      });
}

template class NodalPatch<2>;
template class NodalPatch<3>;

}  // namespace pnpbs
