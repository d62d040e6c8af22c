// SPDX-License-Identifier: BSD-3-Clause
#include "particles/cell_in_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Numbers of directions.
constexpr int kDirectionsInPlane = 720, kDirectionsInSpace = 1024;
// Tolerance at the edges of a facet, so that no direction slips between facets. [facet]
constexpr double kBeside = 1e-9;

Point<2> way(const Point<2>& from, const Point<2>& to) {
  return {to[0] - from[0], to[1] - from[1]};
}
Point<3> way(const Point<3>& from, const Point<3>& to) { return difference(to, from); }

double area(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

// Returns the distance to the facet, or infinity if the direction does not meet it.
double distance_along(const Point<2>& direction, const Point<2>& x, const FacetCorners<2>& facet) {
  const Point<2> to = way(x, facet[0]), along = way(facet[0], facet[1]);
  const double turn = area(direction, along);
  if (turn == 0) return kInfinity;
  const double part = area(to, direction) / turn, distance = area(to, along) / turn;
  const bool meets = distance >= 0 && part >= -kBeside && part <= 1 + kBeside;
  return meets ? distance : kInfinity;
}

// Uses the method of Moeller and Trumbore (1997).
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

// Appends directions that are evenly distributed over the circle.
void append_directions(std::vector<Point<2>>& directions) {
  for (int k = 0; k < kDirectionsInPlane; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / kDirectionsInPlane;
    directions.push_back({std::cos(angle), std::sin(angle)});
  }
}

// Appends directions that are evenly distributed over the sphere, on a spiral with the golden
// angle.
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
  for (const Point<Dim>& direction : directions_)
    for (std::size_t k = 0; k < Dim; ++k) along_[k].push_back(direction[k]);
}

template <int Dim>
double CellInBody<Dim>::volume(const Point<Dim>& x, double reach,
                               std::span<const Point<Dim>> neighbours) const {
  std::vector<double> ends = ends_at_bisectors(x, reach, neighbours);
  // The wall is usually much nearer than `reach`.
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

// Returns whether no facet separates the neighbour from x. `facets` are those of the wall near x.
template <int Dim>
bool CellInBody<Dim>::sees(const Point<Dim>& x, const Point<Dim>& neighbour,
                           std::span<const std::int32_t> facets) const {
  const double far = distance<Dim>(x, neighbour);
  Point<Dim> direction = way(x, neighbour);
  for (double& component : direction) component /= far;
  return std::ranges::none_of(
      facets, [&](std::int32_t f) { return distance_along(direction, x, body_.corners(f)) < far; });
}

template <int Dim>
void CellInBody<Dim>::products_with_directions(const Point<Dim>& vector,
                                               std::vector<double>& products) const {
  std::array<const double*, Dim> along;
  for (std::size_t c = 0; c < Dim; ++c) along[c] = along_[c].data();
  double* const to = products.data();
#pragma omp simd
  for (std::size_t k = 0; k < products.size(); ++k) {
    double product = 0;
    for (std::size_t c = 0; c < Dim; ++c) product += vector[c] * along[c][k];
    to[k] = product;
  }
}

// The distance of a bisector is 1 / t, where t is linear in the direction. Most bisectors are
// behind others, so that the visibility of their neighbours need not be tested.
template <int Dim>
std::vector<double> CellInBody<Dim>::ends_at_bisectors(
    const Point<Dim>& x, double reach, std::span<const Point<Dim>> neighbours) const {
  const std::vector<std::int32_t> facets = body_.facets_near(x, 2 * reach);
  const std::size_t n = directions_.size();
  std::vector<double> nearness(n, 1 / reach), candidate(n);
  for (const Point<Dim>& neighbour : neighbours) {
    Point<Dim> slope = way(x, neighbour);
    const double half = 0.5 * dot(slope, slope);
    for (double& component : slope) component /= half;
    products_with_directions(slope, candidate);
    double gain = -1;
#pragma omp simd reduction(max : gain)
    for (std::size_t k = 0; k < n; ++k) gain = std::max(gain, candidate[k] - nearness[k]);
    if (gain <= 0 || !sees(x, neighbour, facets)) continue;
    for (std::size_t k = 0; k < n; ++k) nearness[k] = std::max(nearness[k], candidate[k]);
  }
  for (double& t : nearness) t = 1 / t;
  return nearness;
}

Point<2> normal_of(const FacetCorners<2>& edge) {
  const Point<2> along = way(edge[0], edge[1]);
  return {-along[1], along[0]};
}
Point<3> normal_of(const FacetCorners<3>& facet) {
  return cross(way(facet[0], facet[1]), way(facet[0], facet[2]));
}

// A facet can only shorten rays that reach its plane before they end.
template <int Dim>
void CellInBody<Dim>::end_at_wall(const Point<Dim>& x, double reach,
                                  std::vector<double>& ends) const {
  constexpr double kRounding = 1 + 1e-9;
  std::vector<double> along(ends.size());
  for (const std::int32_t f : body_.facets_near(x, reach)) {
    const FacetCorners<Dim>& facet = body_.corners(f);
    Point<Dim> normal = normal_of(facet);
    double height = dot(normal, way(x, facet[0]));
    if (height < 0) {
      height = -height;
      for (double& component : normal) component = -component;
    }
    products_with_directions(normal, along);
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (height <= kRounding * ends[k] * along[k])
        ends[k] = std::min(ends[k], distance_along(directions_[k], x, facet));
  }
}

template class CellInBody<2>;
template class CellInBody<3>;

}  // namespace pnpbs
