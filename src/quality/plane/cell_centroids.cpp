// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/cell_centroids.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// A point of the plane or of the unit sphere, with d at this point.
template <std::size_t N>
struct CellCorner {
  std::array<double, N> x;
  double d;
};

template <std::size_t N>
std::array<double, N> combined(double a, const std::array<double, N>& x, double b,
                               const std::array<double, N>& y) {
  std::array<double, N> sum;
  for (std::size_t k = 0; k < N; ++k) sum[k] = a * x[k] + b * y[k];
  return sum;
}

template <std::size_t N>
std::array<double, N> way(const std::array<double, N>& from, const std::array<double, N>& to) {
  return combined(1, to, -1, from);
}

// Maps a point of a flat triangle to the surface: the identity in the plane, the central projection
// on the sphere.
Point<2> raised(const Point<2>& x) { return x; }
Point<3> raised(const Point<3>& x) { return unit_vector(x); }

template <std::size_t N>
CellCorner<N> middle(const CellCorner<N>& a, const CellCorner<N>& b) {
  return {raised(combined(0.5, a.x, 0.5, b.x)), 0.5 * (a.d + b.d)};
}

// Returns the circumcentre of a triangle. The barycentric coordinates of a flat triangle's
// circumcentre are a^2 (b^2 + c^2 - a^2), where a is the opposite side; the central projection of
// this point is the one on the sphere. d is extrapolated linearly and clamped, because far outside
// an obtuse triangle it could be negative.
template <std::size_t N>
CellCorner<N> circumcentre(const CellCorner<N>& o, const CellCorner<N>& a, const CellCorner<N>& b) {
  const auto oa = way(o.x, a.x), ob = way(o.x, b.x), ab = way(a.x, b.x);
  const double aa = dot(oa, oa), bb = dot(ob, ob), cc = dot(ab, ab);
  const double of_a = bb * (cc + aa - bb), of_b = aa * (bb + cc - aa), of_o = cc * (aa + bb - cc);
  const double share = 1 / (of_o + of_a + of_b);
  const auto [min, max] = std::minmax({o.d, a.d, b.d});
  const double d = share * (of_o * o.d + of_a * a.d + of_b * b.d);
  const auto from_o = combined(share * of_a, oa, share * of_b, ob);
  return {raised(combined(1, o.x, 1, from_o)), std::clamp(d, 0.5 * min, 2 * max)};
}

// Returns the point of the edge from a to b that is equally far from o and a.
template <std::size_t N>
CellCorner<N> crossing(const CellCorner<N>& o, const CellCorner<N>& a, const CellCorner<N>& b) {
  const auto ao = way(a.x, o.x), ab = way(a.x, b.x);
  const double share = 0.5 * dot(ao, ao) / dot(ao, ab);
  return {raised(combined(1, a.x, share, ab)), a.d + share * (b.d - a.d)};
}

// Returns twice the area of a flat triangle with edge vectors a and b from o. On a sphere this is
// the constant factor of the projected area element; raised_with_area() returns the factor that
// depends on the point.
double twice_area(const Point<2>&, const Point<2>& a, const Point<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}
double twice_area(const Point<3>& o, const Point<3>& a, const Point<3>& b) {
  return dot(o, cross(a, b));
}

// A projected point and the point's factor of the projected area element.
template <std::size_t N>
struct Raised {
  std::array<double, N> x;
  double area;
};
Raised<2> raised_with_area(const Point<2>& x) { return {x, 1}; }
Raised<3> raised_with_area(const Point<3>& x) {
  const double scale = 1 / length(x);
  return {{scale * x[0], scale * x[1], scale * x[2]}, scale * scale * scale};
}

// The mass and the first moment about the node of its cell, summed over triangles.
template <std::size_t N>
class CellMoments {
 public:
  explicit CellMoments(const CellCorner<N>& node) : node_(node) {}

  // Adds the triangle of the node, a and b, with negative mass if it is oriented clockwise. The
  // quadrature uses the midpoints of the edges and is exact for polynomials of degree 2 (A. Stroud,
  // Approximate calculation of multiple integrals, 1971, formula T2: 2-1).
  void add(const CellCorner<N>& a, const CellCorner<N>& b) {
    const double part = twice_area(node_.x, way(node_.x, a.x), way(node_.x, b.x));
    add_point(part, node_, a);
    add_point(part, a, b);
    add_point(part, b, node_);
  }

  Point<N> centroid() const { return raised(combined(1, node_.x, 1 / mass_, first_)); }

 private:
  void add_point(double part, const CellCorner<N>& a, const CellCorner<N>& b) {
    const Raised<N> at = raised_with_area(combined(0.5, a.x, 0.5, b.x));
    const double ratio = node_.d / (0.5 * (a.d + b.d)), square = ratio * ratio;
    const double mass = part * at.area * square * square;
    mass_ += mass;
    first_ = combined(1, first_, mass, way(node_.x, at.x));
  }

  const CellCorner<N> node_;
  double mass_ = 0;
  std::array<double, N> first_{};
};

template <std::size_t N>
struct CellNeighbour {
  CellCorner<N> corner, halfway;  // `halfway` is the middle of the edge from the node
  bool moves;
};

// Adds the part of a cell that belongs to one triangle of its node. For an obtuse triangle this
// part extends beyond the triangle or is negative; the parts of the adjacent triangles compensate
// for it.
template <std::size_t N>
void add_part(const CellCorner<N>& o, const CellNeighbour<N>& from, const CellNeighbour<N>& to,
              CellMoments<N>& cell) {
  const CellCorner<N>&a = from.corner, &b = to.corner;
  if (!from.moves && !to.moves && dot(way(o.x, a.x), way(o.x, b.x)) < 0) {
    const CellCorner<N> first = crossing(o, a, b), last = crossing(o, b, a);
    cell.add(from.halfway, first);
    cell.add(first, last);
    cell.add(last, to.halfway);
    return;
  }
  const CellCorner<N> centre = circumcentre(o, a, b);
  cell.add(from.halfway, centre);
  cell.add(centre, to.halfway);
}

// Returns the centroid of the cell of node i, whose star must be closed. corner_of(j) returns node
// j as a CellCorner.
template <std::size_t N, class CornerOf>
Point<N> centroid(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i,
                  const CornerOf& corner_of) {
  const CellCorner<N> node = corner_of(i);
  CellMoments<N> cell(node);
  std::optional<CellNeighbour<N>> first, last;
  const auto go_on = [&](const CellNeighbour<N>& next) {
    if (last)
      add_part<N>(node, *last, next, cell);
    else
      first = next;
    last = next;
  };
  stars.for_neighbours(i, [&](std::int64_t j) {
    const CellCorner<N> corner = corner_of(j);
    go_on({corner, middle(node, corner), nodes.moves(j) != 0});
  });
  go_on(*first);
  return cell.centroid();
}

}  // namespace

Point<2> CellCentroids::of(std::int64_t i) const {
  if (!embedding_.is_sphere()) {
    const Point<2> origin = nodes_.position(i);  // limits cancellation
    const Point<2> from_there = centroid<2>(nodes_, stars_, i, [&](std::int64_t j) {
      return CellCorner<2>{way(origin, nodes_.position(j)), nodes_.d(j)};
    });
    return combined(1, origin, 1, from_there);
  }
  const StereographicChart& chart = embedding_.chart();
  return chart.in_chart(centroid<3>(nodes_, stars_, i, [&](std::int64_t j) {
    const Point<2> u = nodes_.position(j);
    return CellCorner<3>{unit_vector(chart.on_sphere(u)), nodes_.d(j) / chart.stretch(u)};
  }));
}

}  // namespace pnpbs
