// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/cell_in_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDirectionsInPlane = 720, kDirectionsInSpace = 1024;
constexpr double kBeside = 1e-9;  // of a facet: a direction that meets it there does not slip by

Point<2> way(const Point<2>& from, const Point<2>& to) {
  return {to[0] - from[0], to[1] - from[1]};
}
Point<3> way(const Point<3>& from, const Point<3>& to) { return difference(to, from); }

double area(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

// How far it is to the facet; infinity where the direction does not meet it.
double distance_along(const Point<2>& direction, const Point<2>& x, const FacetCorners<2>& facet) {
  const Point<2> to = way(x, facet[0]), along = way(facet[0], facet[1]);
  const double turn = area(direction, along);
  if (turn == 0) return kInfinity;
  const double part = area(to, direction) / turn, distance = area(to, along) / turn;
  const bool meets = distance >= 0 && part >= -kBeside && part <= 1 + kBeside;
  return meets ? distance : kInfinity;
}

// By Moeller and Trumbore (1997).
double distance_along(const Point<3>& direction, const Point<3>& x, const FacetCorners<3>& facet) {
  const Point<3> first = way(facet[0], facet[1]), second = way(facet[0], facet[2]);
  const Point<3> across = cross(direction, second);
  const double volume = dot(first, across);
  if (volume == 0) return kInfinity;
  const Point<3> from = way(facet[0], x), turned = cross(from, first);
  const double u = dot(from, across) / volume, v = dot(direction, turned) / volume;
  const double distance = dot(second, turned) / volume;
  const bool meets = distance >= 0 && u >= -kBeside && v >= -kBeside && u + v <= 1 + kBeside;
  return meets ? distance : kInfinity;
}

// Directions that share the circle evenly.
void append_directions(std::vector<Point<2>>& directions) {
  for (int k = 0; k < kDirectionsInPlane; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / kDirectionsInPlane;
    directions.push_back({std::cos(angle), std::sin(angle)});
  }
}

// The same of the sphere: on a spiral, by the golden angle.
void append_directions(std::vector<Point<3>>& directions) {
  for (int k = 0; k < kDirectionsInSpace; ++k) {
    const double z = 1 - (2 * k + 1.0) / kDirectionsInSpace, r = std::sqrt(1 - z * z);
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
}

}  // namespace

template <int Dim>
CellInBody<Dim>::CellInBody(const SignedDistance<Dim>& body) : body_(body) {
  append_directions(directions_);
}

template <int Dim>
double CellInBody<Dim>::volume(const Point<Dim>& x, double reach,
                               std::span<const Point<Dim>> neighbours) const {
  std::vector<double> ends(directions_.size(), reach);
  end_at_bisectors(x, neighbours, ends);
  // Mostly the wall is much nearer.
  double near = reach / 8;
  do {
    near *= 2;
    end_at_wall(x, near, ends);
  } while (*std::ranges::max_element(ends) > near);
  double sum = 0;
  for (const double end : ends) sum += Dim == 2 ? end * end : end * end * end;
  constexpr double kWhole = Dim == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  return kWhole / static_cast<double>(ends.size()) * sum;
}

template <int Dim>
void CellInBody<Dim>::end_at_bisectors(const Point<Dim>& x, std::span<const Point<Dim>> neighbours,
                                       std::vector<double>& ends) const {
  for (const Point<Dim>& neighbour : neighbours) {
    const Point<Dim> to = way(x, neighbour);
    const double half = 0.5 * dot(to, to);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const double along = dot(to, directions_[k]);
      if (ends[k] * along > half) ends[k] = half / along;
    }
  }
}

// Does a ball around a facet meet the way into a direction?
template <int Dim>
class FacetBall {
 public:
  FacetBall(const Point<Dim>& x, const FacetCorners<Dim>& facet) {
    Point<Dim> middle{};
    for (const Point<Dim>& corner : facet)
      for (std::size_t k = 0; k < Dim; ++k) middle[k] += corner[k] / Dim;
    to_ = way(x, middle);
    double radius = 0;
    for (const Point<Dim>& corner : facet)
      radius = std::max(radius, squared_distance<Dim>(middle, corner));
    constexpr double kRounding = 1 + 1e-6;
    least_ = dot(to_, to_) - kRounding * radius;
  }

  bool meets(const Point<Dim>& direction) const {
    const double along = dot(to_, direction);
    return least_ <= 0 || (along > 0 && along * along >= least_);
  }

 private:
  Point<Dim> to_;
  double least_;  // square of what the way from x to the ball's edge is long
};

template <int Dim>
void CellInBody<Dim>::end_at_wall(const Point<Dim>& x, double reach,
                                  std::vector<double>& ends) const {
  for (const std::int32_t f : body_.facets_near(x, reach)) {
    const FacetCorners<Dim>& facet = body_.corners(f);
    const FacetBall<Dim> ball(x, facet);
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (ball.meets(directions_[k]))
        ends[k] = std::min(ends[k], distance_along(directions_[k], x, facet));
  }
}

template class CellInBody<2>;
template class CellInBody<3>;

}  // namespace pnpbs
