// SPDX-License-Identifier: BSD-3-Clause
// An element divided among the sites (nodes) that are nearest in some part of it, which are the
// parts of their Voronoi cells within a triangle or a tetrahedron.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/space_vectors.hpp"

namespace pnpbs {

// A convex piece of a line (Extent 1, a segment) or of a plane (Extent 2, a polygon) that is cut by
// planes. Its memory is reused for the next piece.
template <int Dim, int Extent>
class ConvexPiece {
 public:
  void clear() { size_ = 0; }
  void add(const Point<Dim>& point) {
    make_room(size_ + 1);
    points_[size_++] = point;
  }
  bool empty() const { return size_ == 0; }
  std::span<const Point<Dim>> points() const { return std::span(points_).first(size_); }

  // Keeps the side on which the linear function value(point) is positive. If `with_zero` is set, a
  // piece on which the value is zero everywhere is kept, too.
  template <class Value>
  void cut(const Value& value, bool with_zero) {
    std::size_t first_out = 0;  // Usually no point is outside.
    while (first_out < size_) {
      values_[first_out] = value(points_[first_out]);
      if (!inside(values_[first_out], with_zero)) break;
      ++first_out;
    }
    if (first_out == size_) return;
    for (std::size_t i = first_out + 1; i < size_; ++i) values_[i] = value(points_[i]);
    keep_inside(with_zero);
  }

  // Returns the length or area.
  double measure() const {
    if (size_ <= Extent) return 0;
    if constexpr (Extent == 1)
      return distance<Dim>(points_[0], points_[1]);
    else
      return area();
  }

 private:
  static bool inside(double value, bool with_zero) { return with_zero ? value >= 0 : value > 0; }

  void keep_inside(bool with_zero) {
    make_room(2 * size_);  // With rounding, more than two sides may cross.
    std::size_t kept = 0;
    bool in = inside(values_[0], with_zero);
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t next = i + 1 < size_ ? i + 1 : 0;
      const bool next_in = inside(values_[next], with_zero);
      if (in) kept_[kept++] = points_[i];
      if (in != next_in && !(Extent == 1 && next == 0))
        kept_[kept++] = in ? crossing(i, next) : crossing(next, i);
      in = next_in;
    }
    points_.swap(kept_);
    size_ = kept;
  }

  void make_room(std::size_t points) {
    if (points <= points_.size()) return;
    points_.resize(points);
    kept_.resize(points);
    values_.resize(points);
  }

  Point<Dim> crossing(std::size_t in, std::size_t out) const {
    const double t = values_[in] / (values_[in] - values_[out]);
    Point<Dim> point;
    for (std::size_t k = 0; k < Dim; ++k)
      point[k] = points_[in][k] + t * (points_[out][k] - points_[in][k]);
    return point;
  }

  double area() const {
    Point<3> sum{};
    for (std::size_t i = 1; i + 1 < size_; ++i) {
      const Point<3> normal =
          cross(difference(points_[i], points_[0]), difference(points_[i + 1], points_[0]));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normal[k];
    }
    return 0.5 * length(sum);
  }

  // All have the size of the largest piece until now.
  std::vector<Point<Dim>> points_, kept_;
  std::vector<double> values_;
  std::size_t size_ = 0;
};

// The function |x - r|^2 - |x - p|^2 of points x, which is positive where x is closer to p.
// Swapping p and r changes only its sign.
template <int Dim>
class CloserBy {
 public:
  CloserBy(const Point<Dim>& p, const Point<Dim>& r) {
    for (std::size_t k = 0; k < Dim; ++k) {
      way_[k] = p[k] - r[k];
      sum_[k] = p[k] + r[k];
    }
  }
  double operator()(const Point<Dim>& x) const {
    double sum = 0;
    for (std::size_t k = 0; k < Dim; ++k) sum += way_[k] * (2 * x[k] - sum_[k]);
    return sum;
  }

 private:
  Point<Dim> way_, sum_;
};

// Returns whether a comes before b in the order of coordinates. If two sites are equally far from a
// whole side of an element, this order decides in which of the two elements at the side their
// common face lies.
template <int Dim>
bool is_first(const Point<Dim>& a, const Point<Dim>& b) {
  return a < b;
}

template <int Dim, std::size_t Corners>
class DividedElement {
 public:
  static constexpr int kExtent = static_cast<int>(Corners) - 1;  // Dimension of the element.
  static constexpr std::size_t kPairs = Corners * (Corners - 1) / 2;
  using Piece = ConvexPiece<Dim, kExtent - 1>;

  // Sets the sites, the first of which are the corners. The span must remain valid.
  void set(std::span<const Point<Dim>> sites) { sites_ = sites; }
  std::span<const Point<Dim>> sites() const { return sites_; }

  // Finds the faces between the corners as if they were the only sites.
  void divide_among_corners() {
    for (std::size_t b = 1; b < Corners; ++b)
      for (std::size_t a = 0; a < b; ++a)
        find_face(a, b, sites_.first(Corners), of_corners_[place(a, b)]);
  }
  std::span<const Piece> faces_of_corners() const { return of_corners_; }

  // Returns the common face of sites a < b: the part of the element in which both are as close as
  // the closest site. The face of two corners is cut out of that of divide_among_corners, so it can
  // be requested only once.
  const Piece& face(std::size_t a, std::size_t b) {
    if (b >= Corners) {
      find_face(a, b, sites_, piece_);
      return piece_;
    }
    Piece& piece = of_corners_[place(a, b)];
    const std::size_t site = first_of(a, b);
    for (std::size_t r = Corners; r < sites_.size() && !piece.empty(); ++r) cut(piece, site, r);
    return piece;
  }

  // Returns the part of the side opposite to corner k in which the site is closest.
  const Piece& part_of_side(std::size_t k, std::size_t site) {
    piece_.clear();
    for (std::size_t c = 0; c < Corners; ++c)
      if (c != k) piece_.add(sites_[c]);
    for (std::size_t r = 0; r < sites_.size() && !piece_.empty(); ++r)
      if (r != site) cut(piece_, site, r);
    return piece_;
  }

  // Returns the height vector of corner k, perpendicular to the opposite side and pointing to the
  // corner.
  Point<Dim> height(std::size_t k) const {
    std::array<std::size_t, Corners - 1> side;
    for (std::size_t c = 0, n = 0; c < Corners; ++c)
      if (c != k) side[n++] = c;
    const Point<Dim> along = way(sites_[side[0]], sites_[side[1]]);
    const Point<Dim> up = way(sites_[side[0]], sites_[k]);
    if constexpr (Corners == 3) {
      return plus(up, -dot(up, along) / dot(along, along), along);
    } else {
      const Point<3> normal = cross(along, way(sites_[side[0]], sites_[side[2]]));
      return plus({}, dot(up, normal) / dot(normal, normal), normal);
    }
  }

  // Returns the volume of the part in which a site is closest. It is the sum of the cones from a
  // corner over each face of the part and over the side opposite to this corner. measure_of(other)
  // returns the measure of the face between the site and another.
  template <class Measure>
  double volume(std::size_t site, const Measure& measure_of) {
    const std::size_t apex = site < Corners ? site : 0;
    double sum = 0;
    if (site != apex || may_reach_side(site))
      sum = std::sqrt(squared(height(apex))) * part_of_side(apex, site).measure();
    for (std::size_t other = 0; other < sites_.size(); ++other) {
      if (other == site) continue;
      const double measure = measure_of(other);
      if (measure == 0) continue;
      const double slope = 2 * std::sqrt(squared(within(way(sites_[other], sites_[site]))));
      sum += CloserBy<Dim>(sites_[site], sites_[other])(sites_[apex]) / slope * measure;
    }
    return sum / kExtent;
  }

 private:
  static double squared(const Point<Dim>& a) { return dot(a, a); }
  static Point<Dim> way(const Point<Dim>& from, const Point<Dim>& to) { return plus(to, -1, from); }
  static Point<Dim> plus(const Point<Dim>& a, double t, const Point<Dim>& b) {
    Point<Dim> sum;
    for (std::size_t k = 0; k < Dim; ++k) sum[k] = a[k] + t * b[k];
    return sum;
  }

  // Returns whether a corner may be the closest site somewhere on the opposite side. It would be
  // closer there than all corners of the side. The differences of squared distances are linear, and
  // so is their sum over these corners. If the sum is well below 0 at each of them, the corner is
  // nowhere closest.
  bool may_reach_side(std::size_t corner) const {
    constexpr double kWell = 0.9;  // Far above rounding.
    for (std::size_t a = 0; a < Corners; ++a) {
      if (a == corner) continue;
      double sum = 0;
      for (std::size_t b = 0; b < Corners; ++b)
        if (b != a && b != corner) sum += squared_distance<Dim>(sites_[a], sites_[b]);
      if (sum >= kWell * kExtent * squared_distance<Dim>(sites_[a], sites_[corner])) return true;
    }
    return false;
  }

  // Returns the component of a vector in the plane of the element.
  Point<Dim> within(const Point<Dim>& a) const {
    if constexpr (Dim == 3 && Corners == 3)
      return part_across(a,
                         unit_vector(cross(way(sites_[0], sites_[1]), way(sites_[0], sites_[2]))));
    else
      return a;
  }

  static std::size_t place(std::size_t a, std::size_t b) { return b * (b - 1) / 2 + a; }
  std::size_t first_of(std::size_t a, std::size_t b) const {
    return is_first<Dim>(sites_[a], sites_[b]) ? a : b;
  }

  // Finds the face of sites a and b. It is bitwise the same for b and a.
  void find_face(std::size_t a, std::size_t b, std::span<const Point<Dim>> sites, Piece& piece) {
    if (first_of(a, b) == b) std::swap(a, b);
    begin_at_bisector(sites[a], sites[b], piece);
    for (std::size_t r = 0; r < sites.size() && !piece.empty(); ++r)
      if (r != a && r != b) cut(piece, a, r);
  }

  // Begins a piece with the intersection of the element and the bisector of two points.
  void begin_at_bisector(const Point<Dim>& p, const Point<Dim>& q, Piece& piece) {
    std::array<double, Corners> values;
    std::array<std::size_t, Corners> near, far;
    std::size_t nears = 0, fars = 0;
    const CloserBy<Dim> closer_by(p, q);
    for (std::size_t c = 0; c < Corners; ++c) {
      values[c] = closer_by(sites_[c]);
      if (values[c] > 0)
        near[nears++] = c;
      else
        far[fars++] = c;
    }
    piece.clear();
    const auto add = [&](std::size_t n, std::size_t f) {
      const std::size_t from = near[n], to = far[f];
      piece.add(plus(sites_[from], values[from] / (values[from] - values[to]),
                     way(sites_[from], sites_[to])));
    };
    // Points are added in their order around the piece: consecutive ones have a corner in common.
    for (std::size_t n = 0; n < nears; ++n)
      for (std::size_t f = 0; f < fars; ++f) add(n, n == 0 ? f : fars - 1 - f);
  }

  void cut(Piece& piece, std::size_t site, std::size_t other) {
    const Point<Dim>&p = sites_[site], &r = sites_[other];
    piece.cut(CloserBy<Dim>(p, r), is_first<Dim>(r, p));
  }

  std::span<const Point<Dim>> sites_;
  std::array<Piece, kPairs> of_corners_;
  Piece piece_;
};

}  // namespace pnpbs
