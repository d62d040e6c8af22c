// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of a node as finite volumes on C-grids use it: the polygon of the circumcentres
// of the node's triangles, not clipped at the boundary. On a sphere all lengths and areas are those
// on a sphere of radius 1, as in MPAS grids.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/space_vectors.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "quality/measured_nodes.hpp"
#include "quality/triangle_quality.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {

// Overloads with the same names for points of the plane and for unit vectors.
inline double length_over(const Point<2>&, double chord) { return chord; }
inline double length_over(const Point<3>&, double chord) { return arc_over(chord); }
inline Point<2> arc_middle(const Point<2>& a, const Point<2>& b) { return middle_of<2>(a, b); }
inline Point<2> circumcentre(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const Point<2> u{b[0] - a[0], b[1] - a[1]}, v{c[0] - a[0], c[1] - a[1]};
  const double uu = dot(u, u), vv = dot(v, v), twice = 2 * (u[0] * v[1] - u[1] * v[0]);
  return {a[0] + (v[1] * uu - u[1] * vv) / twice, a[1] + (u[0] * vv - v[0] * uu) / twice};
}

// A sum of triangle areas. Clockwise triangles count as negative.
template <int N>
class TriangleAreas;

template <>
class TriangleAreas<2> {
 public:
  void add(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    twice_ += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  double sum() const { return 0.5 * twice_; }

 private:
  double twice_ = 0;
};

// On a sphere each area is twice the argument of a complex number. The argument of the product of
// these numbers is half of the sum of the areas, so one arc tangent suffices.
template <>
class TriangleAreas<3> {
 public:
  void add(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
    const auto [real, imaginary] = half_area_direction(a, b, c);
    const double real_before = real_;
    // the product of small areas remains close to 1
    real_ = 0.25 * (real * real_before - imaginary * imaginary_);
    imaginary_ = 0.25 * (real * imaginary_ + imaginary * real_before);
  }
  double sum() const { return 2 * std::atan2(imaginary_, real_); }

 private:
  double real_ = 1, imaginary_ = 0;
};

// The shortest edge of a cell divided by its longest: `cellQuality` of the mesh converter of
// MPAS-Tools.
template <int N>
class ShortestOverLongest {
 public:
  void add(const Point<N>& begin, const Point<N>& end) {
    const double square = squared_distance<N>(begin, end);
    shortest_ = std::min(shortest_, square);
    longest_ = std::max(longest_, square);
  }
  double value() const {
    const auto length_of = [](double square) { return length_over(Point<N>(), std::sqrt(square)); };
    return longest_ > 0 ? length_of(shortest_) / length_of(longest_) : 0;
  }

 private:
  // Squared chord lengths.
  double shortest_ = std::numeric_limits<double>::infinity(), longest_ = 0;
};

// The Voronoi cell of one node at a time, with storage that is reused. N is 2 in the plane and 3 on
// a sphere.
template <int N>
class VoronoiRing {
 public:
  // Collects the neighbours of node i, whose star may be open.
  void gather(const MeasuredNodes<2>& measured, const DelaunayStars& stars, std::int64_t i) {
    node_ = i;
    centre_ = place_of(measured, i);
    neighbours_.clear();
    stars.for_neighbours_in_order(i, [&](std::int64_t j, bool triangle) {
      neighbours_.push_back({j, triangle, place_of(measured, j), {}});
    });
  }
  // Computes the vertices of the cell. The star must be closed.
  void find_vertices() {
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      neighbours_[k].vertex = circumcentre(centre_, neighbours_[k].x, neighbours_[next(k)].x);
  }

  std::size_t size() const { return neighbours_.size(); }
  std::int64_t neighbour(std::size_t k) const { return neighbours_[k].node; }

  // Returns whether the edge to neighbour k lies between two triangles but is not crossed by its
  // Voronoi edge. This is the case if one of these triangles has an obtuse angle opposite to the
  // edge.
  bool is_uncrossed(std::size_t k) const {
    const Neighbour &right = neighbours_[before(k)], &left = neighbours_[next(k)];
    if (!right.triangle || !neighbours_[k].triangle) return false;
    return is_obtuse_at(right.x, centre_, neighbours_[k].x) ||
           is_obtuse_at(left.x, centre_, neighbours_[k].x);
  }

  // --- The following functions require find_vertices(). ---
  // Returns the shortest edge of the cell divided by its longest.
  double edge_ratio() const {
    ShortestOverLongest<N> ratio;
    for (std::size_t k = 0; k < size(); ++k) ratio.add(begin_of_edge(k), neighbours_[k].vertex);
    return ratio.value();
  }
  double area() const {
    TriangleAreas<N> areas;
    for (std::size_t k = 0; k < size(); ++k)
      areas.add(centre_, begin_of_edge(k), neighbours_[k].vertex);
    return areas.sum();
  }
  // Returns the distance between the middle of the Voronoi edge and the middle of the edge to
  // neighbour k, divided by the length of the latter.
  double dual_offset(std::size_t k) const {
    const Point<N> dual = arc_middle(begin_of_edge(k), neighbours_[k].vertex);
    return length_between(dual, arc_middle(centre_, neighbours_[k].x)) /
           length_between(centre_, neighbours_[k].x);
  }

 private:
  // A neighbour of the node, with the vertex of the cell after it.
  struct Neighbour {
    std::int64_t node;
    bool triangle;  // whether the node, this neighbour and the next one form a triangle
    Point<N> x;
    Point<N> vertex;  // circumcentre of that triangle
  };

  std::size_t next(std::size_t k) const { return k + 1 < size() ? k + 1 : 0; }
  std::size_t before(std::size_t k) const { return (k > 0 ? k : size()) - 1; }
  const Point<N>& begin_of_edge(std::size_t k) const { return neighbours_[before(k)].vertex; }

  static double length_between(const Point<N>& a, const Point<N>& b) {
    return length_over(a, distance<N>(a, b));
  }

  // Returns the position of node j: relative to the node in the plane, to limit cancellation, and
  // as a unit vector on a sphere.
  Point<N> place_of(const MeasuredNodes<2>& measured, std::int64_t j) const {
    Point<N> x;
    measured.put(j, x);
    if constexpr (N == 3) {
      const double scale = 1 / measured.embedding.radius();
      return {scale * x[0], scale * x[1], scale * x[2]};
    } else {
      const Point<2> from = measured.nodes.position(node_);
      return {x[0] - from[0], x[1] - from[1]};
    }
  }

  std::int64_t node_ = 0;
  Point<N> centre_{};
  std::vector<Neighbour> neighbours_;
};

}  // namespace pnpbs
