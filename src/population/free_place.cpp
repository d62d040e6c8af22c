// SPDX-License-Identifier: BSD-3-Clause
#include "population/free_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// Returns a vector that is perpendicular to `a`, or any unit vector if `a` is zero. It is the
// coordinate axis with the smallest component of `a`, minus its projection on `a`.
template <int Dim>
Point<Dim> square_to(const Point<Dim>& a) {
  int min = 0;
  for (int k = 1; k < Dim; ++k)
    if (std::fabs(a[k]) < std::fabs(a[min])) min = k;
  Point<Dim> b{};
  b[min] = 1;
  const double length = dot(a, a);
  if (length == 0) return b;
  for (int k = 0; k < Dim; ++k) b[k] -= a[min] * a[k] / length;
  return b;
}

// Returns the point at distance d from x that lies away from the neighbours. If these balance each
// other, as in a row of nodes, the point lies at right angles to the nearest of them.
template <int Dim>
Point<Dim> place_away(const Point<Dim>& x, double d, const std::vector<Point<Dim>>& around) {
  constexpr double kBalanced = 0.1;  // share of the largest possible length of the sum
  Point<Dim> crowd{}, to_nearest{};
  double weights = 0, nearest = std::numeric_limits<double>::infinity();
  for (const Point<Dim>& y : around) {
    const double gap = distance<Dim>(x, y);
    if (gap == 0) continue;
    const double weight = 1 / (gap * gap);
    for (int k = 0; k < Dim; ++k) crowd[k] += weight * (y[k] - x[k]);
    weights += weight * gap;
    if (gap >= nearest) continue;
    nearest = gap;
    for (int k = 0; k < Dim; ++k) to_nearest[k] = y[k] - x[k];
  }
  Point<Dim> away;
  for (int k = 0; k < Dim; ++k) away[k] = -crowd[k];
  if (dot(away, away) <= kBalanced * kBalanced * weights * weights) {
    away = square_to<Dim>(to_nearest);
    if (dot(away, crowd) > 0)
      for (int k = 0; k < Dim; ++k) away[k] = -away[k];
  }
  const double length = std::sqrt(dot(away, away));
  Point<Dim> place;
  for (int k = 0; k < Dim; ++k) place[k] = x[k] + d * (away[k] / length);
  return place;
}

// Returns the centre of the circle through x and two points, or nothing if all are collinear.
std::optional<Point<2>> circumcentre(const Point<2>& x, const std::array<Point<2>, 2>& others) {
  const auto& [b, c] = others;
  const double bx = b[0] - x[0], by = b[1] - x[1], cx = c[0] - x[0], cy = c[1] - x[1];
  const double area = 2 * (bx * cy - by * cx);
  if (area == 0) return std::nullopt;
  const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  return Point<2>{x[0] + (cy * bb - by * cc) / area, x[1] + (bx * cc - cx * bb) / area};
}

// Returns the centre of the sphere through x and three points, or nothing if all are coplanar.
std::optional<Point<3>> circumcentre(const Point<3>& x, const std::array<Point<3>, 3>& others) {
  std::array<Point<3>, 3> to;
  std::array<double, 3> square;
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t k = 0; k < 3; ++k) to[n][k] = others[n][k] - x[k];
    square[n] = dot(to[n], to[n]);
  }
  const std::array<Point<3>, 3> normal{cross(to[1], to[2]), cross(to[2], to[0]),
                                       cross(to[0], to[1])};
  const double volume = 2 * dot(to[0], normal[0]);
  if (volume == 0) return std::nullopt;
  Point<3> centre;
  for (std::size_t k = 0; k < 3; ++k)
    centre[k] =
        x[k] +
        (square[0] * normal[0][k] + square[1] * normal[1][k] + square[2] * normal[2][k]) / volume;
  return centre;
}

// Calls visit(corners) for every choice of `Left` of the first `end` points. The first Dim - `Left`
// corners are already chosen.
template <int Left, int Dim, class Visit>
void for_choices(const std::vector<Point<Dim>>& points, std::size_t end,
                 std::array<Point<Dim>, Dim>& corners, const Visit& visit) {
  if constexpr (Left == 0) {
    visit(corners);
  } else {
    for (std::size_t j = 0; j < end; ++j) {
      corners[Dim - Left] = points[j];
      for_choices<Left - 1, Dim>(points, j, corners, visit);
    }
  }
}

// Returns the centre of the largest hole beside x: of the empty circles (spheres) through x and two
// (three) neighbours, the one with the largest radius. Returns nothing if that radius exceeds d or
// if there are too few neighbours.
template <int Dim>
std::optional<Point<Dim>> hole_beside(const Point<Dim>& x, double d,
                                      const std::vector<Point<Dim>>& around) {
  constexpr double kRounding = 1 - 1e-9;
  const auto is_empty = [&](const Point<Dim>& centre, double radius) {
    return std::none_of(around.begin(), around.end(), [&](const Point<Dim>& y) {
      return distance<Dim>(y, centre) < kRounding * radius;
    });
  };
  std::optional<Point<Dim>> hole;
  double max = 0;
  std::array<Point<Dim>, Dim> corners;
  for_choices<Dim, Dim>(around, around.size(), corners, [&](const auto& chosen) {
    const std::optional<Point<Dim>> centre = circumcentre(x, chosen);
    if (!centre) return;
    const double radius = distance<Dim>(x, *centre);
    if (radius <= max || !is_empty(*centre, radius)) return;
    max = radius;
    hole = centre;
  });
  if (max > d) hole.reset();
  return hole;
}

}  // namespace

template <int Dim>
Point<Dim> free_place(const Point<Dim>& x, double d, const std::vector<Point<Dim>>& around) {
  if (const std::optional<Point<Dim>> hole = hole_beside<Dim>(x, d, around)) return *hole;
  return place_away<Dim>(x, d, around);
}

template Point<2> free_place<2>(const Point<2>&, double, const std::vector<Point<2>>&);
template Point<3> free_place<3>(const Point<3>&, double, const std::vector<Point<3>>&);

}  // namespace pnpbs
