// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells cut by brute force from the unit square or cube.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace brute {

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator*(double t, const Point& a) { return {t * a[0], t * a[1], t * a[2]}; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

struct HalfSpace {
  Point normal;
  double limit;  // normal . x <= limit
};

inline Polygon cut(const Polygon& polygon, const HalfSpace& by) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double in_a = by.limit - dot(by.normal, a), in_b = by.limit - dot(by.normal, b);
    if (in_a >= 0) kept.push_back(a);
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0))
      kept.push_back(a + in_a / (in_a - in_b) * (b - a));
  }
  return kept;
}

inline double area(const Polygon& polygon) {
  Point sum{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return length(sum) / 2;
}

// Returns a square in the boundary plane of a half space, far larger than all cells.
inline Polygon large_square(const HalfSpace& at) {
  const Point middle = at.limit / dot(at.normal, at.normal) * at.normal;
  const Point aside =
      std::abs(at.normal[0]) < 0.6 * length(at.normal) ? Point{1, 0, 0} : Point{0, 1, 0};
  Point u = cross(at.normal, aside), v = cross(at.normal, u);
  u = 9 / length(u) * u;
  v = 9 / length(v) * v;
  return {middle + u + v, middle + u - v, middle - u - v, middle - u + v};
}

// Returns the volume of the cell, and the area of its face to each of `others`. In the plane both
// are those of a slab of thickness 1.
inline double brute_cell(const Point& x, const std::vector<Point>& others,
                         std::vector<double>& areas) {
  std::vector<HalfSpace> spaces;
  for (const Point& other : others)
    spaces.push_back({other - x, (dot(other, other) - dot(x, x)) / 2});
  for (std::size_t k = 0; k < 3; ++k) {
    Point axis{};
    axis[k] = 1;
    spaces.push_back({axis, 1});
    spaces.push_back({-1. * axis, 0});
  }
  double volume = 0;
  areas.clear();
  for (std::size_t s = 0; s < spaces.size(); ++s) {
    Polygon face = large_square(spaces[s]);
    for (std::size_t r = 0; r < spaces.size() && !face.empty(); ++r)
      if (r != s) face = cut(face, spaces[r]);
    areas.push_back(area(face));
    volume +=
        areas.back() * (spaces[s].limit - dot(spaces[s].normal, x)) / length(spaces[s].normal) / 3;
  }
  return volume;
}

}  // namespace brute
