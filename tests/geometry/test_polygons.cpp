// SPDX-License-Identifier: BSD-3-Clause
// Triangulations of polygons: they cover the polygon once and avoid needles.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "formats/polygons.hpp"
#include "geometry/plane/polygon_triangles.hpp"
#include "run_suite.hpp"

using pnpbs::Point;
using pnpbs::SurfaceTriangles;
using Triangles = std::vector<std::array<std::int32_t, 3>>;
using Polygon = std::vector<Point<2>>;

namespace {

const Point<2>& corner(const Polygon& polygon, std::int32_t i) {
  return polygon[static_cast<std::size_t>(i)];
}

double area2(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double shoelace(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point<2>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += p[0] * q[1] - p[1] * q[0];
  }
  return sum;
}

// Expects each side of the polygon once, each inner edge in two triangles, and areas that add up.
Triangles expect_filled(const Polygon& polygon) {
  const Triangles triangles = pnpbs::polygon_triangles(polygon);
  const auto count = static_cast<std::int32_t>(polygon.size());
  ck_assert_uint_eq(triangles.size(), polygon.size() - 2);
  double sum = 0;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : triangles) {
    const double area = area2(corner(polygon, t[0]), corner(polygon, t[1]), corner(polygon, t[2]));
    ck_assert_double_gt(area, 0);
    sum += area;
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  ck_assert_double_eq_tol(sum, shoelace(polygon), 1e-12 * std::fabs(sum));
  std::sort(edges.begin(), edges.end());
  ck_assert(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
  std::int32_t sides = 0;
  for (const auto& [a, b] : edges) {
    if (std::binary_search(edges.begin(), edges.end(), std::pair{b, a})) continue;
    ck_assert_int_eq(b, a + 1 < count ? a + 1 : 0);
    ++sides;
  }
  ck_assert_int_eq(sides, count);
  return triangles;
}

double least_angle(const Polygon& polygon, const Triangles& triangles) {
  double least = 180;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point<2>&a = corner(polygon, t[k]), &b = corner(polygon, t[(k + 1) % 3]),
            &c = corner(polygon, t[(k + 2) % 3]);
      const double dot = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
      least = std::min(least, std::atan2(area2(a, b, c), dot) * 180 / std::numbers::pi);
    }
  }
  return least;
}

// Returns a star-shaped polygon with random radii, which has corners of every kind.
Polygon star(int count, std::uint32_t seed, double low) {
  std::mt19937 random(seed);
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double radius = low + (1 - low) * static_cast<double>(random() % 1000) / 1000;
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return polygon;
}

SurfaceTriangles lifted(const Polygon& polygon) {
  SurfaceTriangles surface;
  for (const auto& [x, y] : polygon) surface.vertices.push_back({x, y, 3 - 2 * x + 5 * y});
  return surface;
}

std::string problem_of(SurfaceTriangles surface, bool backwards = false) {
  std::vector<std::int32_t> corners;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    corners.push_back(static_cast<std::int32_t>(i));
  if (backwards) std::reverse(corners.begin(), corners.end());
  const std::string problem = pnpbs::add_polygon(surface, corners, 7);
  ck_assert(surface.triangles.empty() != problem.empty());
  ck_assert(surface.tags == std::vector<std::int32_t>(surface.triangles.size(), 7));
  return problem;
}

}  // namespace

START_TEST(convex_polygons) {
  expect_filled({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  // The shorter diagonal is used, wherever the polygon begins.
  Polygon kite{{0, 0}, {4, -1}, {8, 0}, {4, 1}};
  for (int turn = 0; turn < 4; ++turn) {
    ck_assert_double_gt(least_angle(kite, expect_filled(kite)), 20);
    std::rotate(kite.begin(), kite.begin() + 1, kite.end());
  }
  expect_filled(star(1000, 1, 1));
}
END_TEST

START_TEST(polygons_with_corners_that_point_inwards) {
  expect_filled({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});  // an L
  for (std::uint32_t seed = 0; seed < 200; ++seed)
    expect_filled(star(4 + static_cast<int>(seed), seed, 0.05));
  // A comb, whose teeth hide each other.
  Polygon comb;
  for (int i = 0; i < 100; ++i) {
    comb.push_back({static_cast<double>(i), 0});
    comb.push_back({i + 0.5, 9});
  }
  comb.push_back({100, 10});
  comb.push_back({-1, 10});
  expect_filled(comb);
  // A spiral of several turns, there and back.
  Polygon spiral;
  for (int i = 0; i <= 200; ++i)
    spiral.push_back({(1 + 0.02 * i) * std::cos(0.1 * i), (1 + 0.02 * i) * std::sin(0.1 * i)});
  for (int i = 200; i >= 0; --i)
    spiral.push_back({(0.5 + 0.02 * i) * std::cos(0.1 * i), (0.5 + 0.02 * i) * std::sin(0.1 * i)});
  expect_filled(spiral);
}
END_TEST

START_TEST(corners_on_straight_sides) {
  expect_filled({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  expect_filled({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}});
  expect_filled({{0, 0}, {3, 0}, {0, 3}, {0, 2}, {0, 1}});
  // Nearly straight corners as they result from rounded coordinates: a corner with such a small
  // bulge must not become a needle of its own.
  for (const double bulge : {1e-16, 1e-12, -1e-12}) {
    const Polygon polygon{{0, 0}, {0.5, -bulge}, {1, 0}, {0.5, 0.8660254037844386}};
    for (std::size_t turn = 0; turn < 4; ++turn) {
      Polygon turned = polygon;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
      ck_assert_double_gt(least_angle(turned, expect_filled(turned)), 29);
    }
  }
}
END_TEST

// No visible corner lies inside the circumcircle of the triangle behind an edge.
START_TEST(edges_are_delaunay) {
  const Polygon polygon = star(60, 5, 0.2);
  const Triangles triangles = expect_filled(polygon);
  const auto apex_over = [&](std::int32_t a, std::int32_t b) {
    for (const auto& t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == a && t[(k + 1) % 3] == b) return t[(k + 2) % 3];
    return -1;
  };
  const auto angle_at = [&](std::int32_t c, std::int32_t a, std::int32_t b) {
    const Point<2>&p = corner(polygon, c), &q = corner(polygon, a), &r = corner(polygon, b);
    return std::atan2(area2(p, q, r),
                      (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]));
  };
  int inside = 0;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3], across = apex_over(b, a);
      if (across < 0) continue;
      ++inside;
      ck_assert_double_le(angle_at(t[(k + 2) % 3], a, b) + angle_at(across, b, a),
                          std::numbers::pi + 1e-9);
    }
  }
  ck_assert_int_eq(inside, 2 * 57);
}
END_TEST

START_TEST(polygons_in_space) {
  const Polygon hook{{0, 0}, {2, 0}, {2, 1}, {1, 0.5}, {0, 1}};
  for (const bool backwards : {false, true}) {
    for (std::size_t shift = 0; shift < 3; ++shift) {
      SurfaceTriangles surface = lifted(hook);
      for (Point<3>& x : surface.vertices)
        std::rotate(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(shift), x.end());
      std::vector<std::int32_t> corners{0, 1, 2, 3, 4};
      if (backwards) std::reverse(corners.begin(), corners.end());
      ck_assert(pnpbs::add_polygon(surface, corners, 7).empty());
      ck_assert_uint_eq(surface.triangles.size(), 3);
      // All triangles have the same orientation along the axis that was x, y or z, and cover the
      // hook.
      const std::size_t first = (3 - shift) % 3, second = (4 - shift) % 3;
      double sum = 0;
      for (const auto& t : surface.triangles) {
        std::array<Point<2>, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
          const Point<3>& x = surface.vertices[static_cast<std::size_t>(t[k])];
          p[k] = {x[first], x[second]};
        }
        const double area = area2(p[0], p[1], p[2]);
        ck_assert(backwards ? area < 0 : area > 0);
        sum += area;
      }
      ck_assert_double_eq_tol(std::fabs(sum), shoelace(hook), 1e-12);
    }
  }
}
END_TEST

START_TEST(polygons_that_are_none) {
  for (const bool backwards : {false, true}) {
    const auto problem = [backwards](const Polygon& polygon) {
      return problem_of(lifted(polygon), backwards);
    };
    const std::string polygon = "a polygon of 4 corners ";
    ck_assert(problem({{0, 0}, {1, 0}, {2, 0}, {3, 0}}) == polygon + "has no area");
    // A bow tie of two equal halves.
    ck_assert(problem({{0, 0}, {1, 1}, {1, 0}, {0, 1}}) == polygon + "has no area");
    const std::string crossing =
        polygon +
        "cannot be divided into triangles: it crosses or touches itself, or is too intricate";
    ck_assert(problem({{0, 0}, {2, 2}, {2, 0}, {0, 1}}) == crossing);
    ck_assert(problem({{0, 0}, {2, 0}, {1, 0}, {0, 1}}) == crossing);
    ck_assert(problem({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}) != "");  // touches its side
    ck_assert(problem({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).empty());
  }
}
END_TEST

TEST_SUITE(test_polygons) {
  return run_suite("polygons", {convex_polygons, polygons_with_corners_that_point_inwards,
                                corners_on_straight_sides, edges_are_delaunay, polygons_in_space,
                                polygons_that_are_none});
}
