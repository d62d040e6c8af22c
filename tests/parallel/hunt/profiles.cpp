// SPDX-License-Identifier: BSD-3-Clause
//
// Extruded plates and profiles with thin walls: L, T, H, U, combs and frames.
#include <algorithm>
#include <cmath>

#include "body.hpp"

namespace hunt {

namespace {

using Flat = std::array<double, 2>;

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Triangulates a counter-clockwise polygon by ear clipping.
std::vector<std::array<std::int64_t, 3>> triangles_of(const std::vector<Flat>& outline) {
  std::vector<std::int64_t> left(outline.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::int64_t>(i);
  std::vector<std::array<std::int64_t, 3>> triangles;
  while (left.size() > 2) {
    const std::size_t before = left.size();
    for (std::size_t i = 0; i < left.size(); ++i) {
      const std::int64_t a = left[(i + left.size() - 1) % left.size()], b = left[i],
                         c = left[(i + 1) % left.size()];
      bool is_ear = turn(outline[a], outline[b], outline[c]) > 0;
      for (const std::int64_t k : left)
        if (k != a && k != b && k != c && turn(outline[a], outline[b], outline[k]) >= 0 &&
            turn(outline[b], outline[c], outline[k]) >= 0 &&
            turn(outline[c], outline[a], outline[k]) >= 0)
          is_ear = false;
      if (!is_ear) continue;
      triangles.push_back({a, b, c});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    if (left.size() == before) break;  // the remaining polygon is degenerate
  }
  return triangles;
}

Mesh extruded(const std::vector<Flat>& outline, double height, double shear) {
  Mesh mesh;
  const auto n = static_cast<std::int64_t>(outline.size());
  for (int top = 0; top < 2; ++top)
    for (const auto& [x, y] : outline)
      mesh.points.push_back({x + (top ? shear * height : 0), y, top ? height : 0});
  for (const auto& [a, b, c] : triangles_of(outline)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + n, b + n, c + n});
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t j = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{i, j, j + n}, {i, j + n, i + n}});
  }
  return mesh;
}

std::vector<Flat> comb(Random& random, double wall) {
  const int teeth = random.pick(2, 6);
  const double depth = random.between(2, 9), gap = random.scale(0.3, 3);
  std::vector<Flat> outline{{0, 0}, {teeth * wall + (teeth - 1) * gap, 0}};
  for (int k = teeth - 1; k >= 0; --k) {
    const double left = k * (wall + gap);
    outline.push_back({left + wall, wall + depth});
    outline.push_back({left, wall + depth});
    if (k == 0) break;
    outline.push_back({left, wall});
    outline.push_back({left - gap, wall});
  }
  return outline;
}

}  // namespace

std::vector<Flat> random_outline(Random& random, double wall, std::string& name) {
  const double a = wall + random.between(2, 12), b = wall + random.between(2, 12), t = wall;
  const char* names[] = {"plate", "l", "t", "h", "u", "comb", "z"};
  const int kind = random.pick(0, 6);
  name = names[kind];
  switch (kind) {
    case 0:
      return {{0, 0}, {a, 0}, {a, t}, {0, t}};
    case 1:
      return {{0, 0}, {a, 0}, {a, t}, {t, t}, {t, b}, {0, b}};
    case 2:
      return {{0, 0},
              {a, 0},
              {a, t},
              {a / 2 + t / 2, t},
              {a / 2 + t / 2, b},
              {a / 2 - t / 2, b},
              {a / 2 - t / 2, t},
              {0, t}};
    case 3:
      return {{0, 0},     {t, 0}, {t, b / 2 - t / 2}, {a, b / 2 - t / 2}, {a, 0}, {a + t, 0},
              {a + t, b}, {a, b}, {a, b / 2 + t / 2}, {t, b / 2 + t / 2}, {t, b}, {0, b}};
    case 4:
      return {{0, 0}, {a + t, 0}, {a + t, b}, {a, b}, {a, t}, {t, t}, {t, b}, {0, b}};
    case 5:
      return comb(random, t);
    default:
      return {{0, 0},         {a, 0},     {a, b}, {a + a / 2, b}, {a + a / 2, b + t},
              {a - t, b + t}, {a - t, t}, {0, t}};
  }
}

Body random_profile(Random& random, double nodes) {
  Body body;
  const double wall = random.scale(0.3, 3);
  std::string name;
  std::vector<Flat> outline = random_outline(random, wall, name);
  double around = 0, area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [x, y] = outline[i];
    const auto& [u, v] = outline[(i + 1) % outline.size()];
    around += std::hypot(u - x, v - y);
    area += (x * v - u * y) / 2;
  }
  const double height = std::max(0.5, (nodes - 2.3 * area) / nodes_of(around, area));
  body.name = "profile/" + name;
  body.meshes.push_back(extruded(outline, height, random.chance(0.3) ? random.between(-1, 1) : 0));
  refine(body.meshes[0], random.pick(0, 3));
  return body;
}

}  // namespace hunt
