// SPDX-License-Identifier: BSD-3-Clause
#include "formats/polygons.hpp"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "geometry/plane/polygon_triangles.hpp"

namespace pnpbs {

namespace {

bool repeats_a_vertex(std::span<const std::int32_t> corners) {
  return std::set<std::int32_t>(corners.begin(), corners.end()).size() < corners.size();
}

// Returns the corners without those that repeat the one before.
std::vector<std::int32_t> without_edges_of_no_length(std::span<const std::int32_t> corners) {
  std::vector<std::int32_t> left;
  for (const std::int32_t corner : corners)
    if (left.empty() || left.back() != corner) left.push_back(corner);
  while (left.size() > 1 && left.back() == left.front()) left.pop_back();
  return left;
}

// Returns the normal of the polygon, with twice its area as length.
Point<3> area_vector(const std::vector<Point<3>>& x, std::span<const std::int32_t> corners) {
  const Point<3>& origin = x[static_cast<std::size_t>(corners[0])];
  Point<3> sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    Point<3> a = x[static_cast<std::size_t>(corners[i])];
    Point<3> b = x[static_cast<std::size_t>(corners[i + 1])];
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] -= origin[k];
      b[k] -= origin[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      sum[k] += a[l] * b[m] - a[m] * b[l];
    }
  }
  return sum;
}

// Projects the polygon along the axis nearest to the normal, so that it is counter-clockwise.
std::vector<Point<2>> projected(const std::vector<Point<3>>& x,
                                std::span<const std::int32_t> corners, const Point<3>& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(first, second);
  std::vector<Point<2>> points;
  points.reserve(corners.size());
  for (const std::int32_t corner : corners) {
    const Point<3>& p = x[static_cast<std::size_t>(corner)];
    points.push_back({p[first], p[second]});
  }
  return points;
}

}  // namespace

std::string add_polygon(SurfaceTriangles& surface, std::span<const std::int32_t> given,
                        std::int32_t tag) {
  const auto problem = [&given](const std::string& what) {
    return "a polygon of " + std::to_string(given.size()) + " corners " + what;
  };
  if (given.size() < 3) return problem("has no area, expected 3 corners or more");
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    surface.triangles.push_back({a, b, c});
    surface.tags.push_back(tag);
  };
  if (given.size() == 3) {
    add(given[0], given[1], given[2]);
    return "";
  }
  const std::vector<std::int32_t> corners = without_edges_of_no_length(given);
  if (corners.size() <= 3) {  // fewer than 3: a degenerate polygon, as STL files contain them
    add(corners[0], corners[corners.size() / 2], corners.back());
    return "";
  }
  if (repeats_a_vertex(corners)) return problem("has a vertex twice");
  const Point<3> normal = area_vector(surface.vertices, corners);
  if (normal == Point<3>{}) return problem("has no area");
  const auto triangles = polygon_triangles(projected(surface.vertices, corners, normal));
  if (triangles.empty())
    return problem(
        "cannot be divided into triangles: it crosses or touches itself, or is too intricate");
  for (const auto& [a, b, c] : triangles)
    add(corners[static_cast<std::size_t>(a)], corners[static_cast<std::size_t>(b)],
        corners[static_cast<std::size_t>(c)]);
  return "";
}

}  // namespace pnpbs
