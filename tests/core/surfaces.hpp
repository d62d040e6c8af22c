// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces with integer coordinates, and exact predicates for them: the side of an
// integer point, and its distance from a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "quick_assert.hpp"
#include "surfaces/triangulation.hpp"

namespace surfaces {

__extension__ using Wide = __int128;
struct Place : std::array<std::int64_t, 3> {};
using Triangle = std::array<std::int32_t, 3>;

inline Place operator-(const Place& a, const Place& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Place operator+(const Place& a, const Place& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Place operator*(std::int64_t t, const Place& a) { return {t * a[0], t * a[1], t * a[2]}; }
inline Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Wide dot(const Place& a, const Place& b) {
  return Wide(a[0]) * b[0] + Wide(a[1]) * b[1] + Wide(a[2]) * b[2];
}
inline int sign(Wide value) { return (value > 0) - (value < 0); }

struct Surface {
  double unit = 1;  // length of the integer unit, a power of two
  std::vector<Place> nodes;
  std::vector<Triangle> triangles;

  pnpbs::Point<3> at(const Place& x) const {
    return {unit * static_cast<double>(x[0]), unit * static_cast<double>(x[1]),
            unit * static_cast<double>(x[2])};
  }
  const Place& corner(std::size_t t, int k) const {
    return nodes[static_cast<std::size_t>(triangles[t][static_cast<std::size_t>(k)])];
  }

  void add_to(pnpbs::BoundaryMesh<3>& mesh, pnpbs::SurfaceRole role, std::int32_t tag = 1) const {
    std::vector<pnpbs::Point<3>> points;
    for (const Place& x : nodes) points.push_back(at(x));
    pnpbs::add_surface(mesh, role, points, triangles,
                       std::vector<std::int32_t>(triangles.size(), tag));
  }

  pnpbs::Box<3> bounds() const {
    pnpbs::Box<3> box{at(nodes[0]), at(nodes[0])};
    for (const Place& x : nodes)
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], at(x)[k]);
        box.high[k] = std::max(box.high[k], at(x)[k]);
      }
    return box;
  }
};

// ------------------------------------------------------------------ shapes ---------------------

// Returns an icosahedron on a sphere, each triangle of which is cut into four `cuts` times.
// Coordinates are multiples of six, so that the midpoints of edges and triangles are integers.
inline Surface sphere(int cuts, std::int64_t radius) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  std::vector<std::array<double, 3>> x{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                       {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                       {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  Surface s;
  s.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(x.size()));
      if (is_new) {
        const auto &p = x[static_cast<std::size_t>(a)], &q = x[static_cast<std::size_t>(b)];
        std::array<double, 3> m{p[0] + q[0], p[1] + q[1], p[2] + q[2]};
        const double scale = std::sqrt(1 + g * g) / std::hypot(m[0], m[1], m[2]);
        for (double& along : m) along *= scale;
        x.push_back(m);
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    s.triangles = finer;
  }
  for (const auto& p : x) {
    Place place;
    for (std::size_t k = 0; k < 3; ++k)
      place[k] = 6 * std::llround(p[k] / std::sqrt(1 + g * g) * static_cast<double>(radius) / 6);
    s.nodes.push_back(place);
  }
  return s;
}

// Returns the surface of all cubes of width six for which solid(i, j, k) holds, 0 <= i, j, k < n.
// Squares are cut along alternating diagonals.
template <class Solid>
Surface cubes(std::int64_t n, const Solid& solid) {
  Surface s;
  std::map<Place, std::int32_t> numbers;
  const auto node = [&](const Place& x) {
    const auto [entry, is_new] = numbers.try_emplace(x, static_cast<std::int32_t>(s.nodes.size()));
    if (is_new) s.nodes.push_back(6 * x);
    return entry->second;
  };
  const auto filled = [&](const Place& c) {
    for (const std::int64_t along : c)
      if (along < 0 || along >= n) return false;
    return solid(c[0], c[1], c[2]);
  };
  for (std::int64_t cell = 0; cell < n * n * n; ++cell) {
    const Place c{cell % n, cell / n % n, cell / n / n};
    if (!filled(c)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::int64_t side : {0, 1}) {
        Place beyond = c, u{}, v{}, corner = c;
        beyond[k] += 2 * side - 1;
        if (filled(beyond)) continue;
        corner[k] += side;
        u[(k + (side == 1 ? 1 : 2)) % 3] = 1;  // u x v points outwards
        v[(k + (side == 1 ? 2 : 1)) % 3] = 1;
        const std::int32_t p = node(corner), q = node(corner + u), r = node(corner + u + v),
                           t = node(corner + v);
        if ((c[0] * 7 + c[1] * 5 + c[2] * 3 + static_cast<std::int64_t>(k)) % 4 < 2) {
          s.triangles.push_back({p, q, r});
          s.triangles.push_back({p, r, t});
        } else {
          s.triangles.push_back({p, q, t});
          s.triangles.push_back({q, r, t});
        }
      }
  }
  return s;
}

// Returns a cube with a hole from bottom to top and a cavity beside it.
inline Surface pierced_cube() {
  return cubes(8, [](std::int64_t i, std::int64_t j, std::int64_t k) {
    const bool hole = i >= 4 && i < 6 && j >= 3 && j < 6;
    const bool cavity = i >= 1 && i < 3 && j >= 2 && j < 4 && k >= 3 && k < 6;
    return !hole && !cavity;
  });
}

// Returns the same shape, oblique to the axes.
inline Surface sheared(Surface s) {
  for (Place& x : s.nodes)
    x = {3 * x[0] + x[1] - x[2], 2 * x[1] - x[0] + x[2], 3 * x[2] + 2 * x[0] - x[1]};
  return s;
}

// ------------------------------------------------------------------ exact predicates ----------

// x is in the integer units of the surface.
inline bool on_triangle(const Surface& s, std::size_t t, const Place& x) {
  const Place a = s.corner(t, 0) - x, b = s.corner(t, 1) - x, c = s.corner(t, 2) - x;
  const Place normal = cross(b - a, c - a);
  return dot(normal, a) == 0 && dot(normal, cross(a, b)) >= 0 && dot(normal, cross(b, c)) >= 0 &&
         dot(normal, cross(c, a)) >= 0;
}

inline bool on_surface(const Surface& s, const Place& x) {
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    if (on_triangle(s, t, x)) return true;
  return false;
}

// Counts how often a ray crosses the surface. If the ray meets an edge or a corner, or runs within
// a triangle, another direction is tried.
inline bool is_inside(const Surface& s, const Place& x) {
  for (std::int64_t trial = 0; trial < 100; ++trial) {
    const Place ray{1009 + 7 * trial, 31 - trial * trial, 211 + 3 * trial};
    int crossings = 0;
    bool clear = true;
    for (std::size_t t = 0; t < s.triangles.size() && clear; ++t) {
      const Place a = s.corner(t, 0) - x, b = s.corner(t, 1) - x, c = s.corner(t, 2) - x;
      const int sides[3] = {sign(dot(ray, cross(a, b))), sign(dot(ray, cross(b, c))),
                            sign(dot(ray, cross(c, a)))};
      const auto [low, high] = std::minmax({sides[0], sides[1], sides[2]});
      if (low < 0 && high > 0) continue;  // the ray misses the triangle
      const Place normal = cross(b - a, c - a);
      const int ahead = sign(dot(normal, a)) * sign(dot(normal, ray));
      if (ahead < 0) continue;
      clear = ahead > 0 && low == high;
      ++crossings;
    }
    if (clear) return crossings % 2 == 1;
  }
  ck_abort_msg("no ray is clear");
}

// Returns the squared distance of x from a triangle; only the result is rounded.
inline long double squared_gap(const Surface& s, std::size_t t, const Place& x) {
  const Place corners[3] = {s.corner(t, 0) - x, s.corner(t, 1) - x, s.corner(t, 2) - x};
  const auto& [a, b, c] = corners;
  const Place normal = cross(b - a, c - a);
  if (dot(normal, normal) > 0 && dot(normal, cross(a, b)) >= 0 && dot(normal, cross(b, c)) >= 0 &&
      dot(normal, cross(c, a)) >= 0) {
    const Wide volume = dot(normal, a);
    return static_cast<long double>(volume * volume) /
           static_cast<long double>(dot(normal, normal));
  }
  long double min = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Place &p = corners[k], &q = corners[(k + 1) % 3];
    const Place way = q - p;
    const Wide along = -dot(p, way), length2 = dot(way, way);
    const Place area = cross(p, q);
    const long double gap = along <= 0         ? static_cast<long double>(dot(p, p))
                            : along >= length2 ? static_cast<long double>(dot(q, q))
                                               : static_cast<long double>(dot(area, area)) /
                                                     static_cast<long double>(length2);
    min = std::min(min, gap);
  }
  return min;
}

}  // namespace surfaces
