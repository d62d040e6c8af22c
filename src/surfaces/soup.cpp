// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/soup.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>

#include "base/index.hpp"
#include "geometry/volume/welding.hpp"

namespace pnpbs {

namespace {

void weld(Triangulation& surface, double tolerance) {
  const std::vector<std::int32_t> joined = weld_points(surface.vertices, tolerance);
  for (SurfaceTriangle& triangle : surface.triangles)
    for (std::int32_t& v : triangle.vertices) v = joined[index(v)];
}

bool is_none(const SurfaceTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  return a == b || b == c || c == a;
}

}  // namespace

Triangulation joined_soup(const std::vector<SurfaceSource>& given, double tolerance) {
  Triangulation surface = join_surfaces(given);
  weld(surface, tolerance);
  std::set<std::array<std::int32_t, 3>> there;
  std::erase_if(surface.triangles, [&](const SurfaceTriangle& triangle) {
    std::array<std::int32_t, 3> corners = triangle.vertices;
    std::sort(corners.begin(), corners.end());
    return is_none(triangle) || !there.insert(corners).second;
  });
  return surface;
}

}  // namespace pnpbs
